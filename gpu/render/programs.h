#pragma once

#include <map>
#include <span>
#include <string>

#include <Eigen/Core>

#include "gpu/objects.h"

namespace vesselbench {

/// Sets uniforms of the program in use by name; names that a shader does not use are skipped.
class Uniforms {
public:
    /// Uses the program.
    explicit Uniforms(const Program& program);

    void set(const char* name, int value) const;
    void set(const char* name, unsigned value) const;
    void set(const char* name, double value) const;
    void set(const char* name, const Eigen::Vector2d& value) const;
    void set(const char* name, const Eigen::Vector3f& value) const;
    void set(const char* name, const Eigen::Vector4d& value) const;
    void set(const char* name, std::span<const Eigen::Vector3f> values) const;
    void set(const char* name, const Eigen::Matrix4d& value) const;

private:
    [[nodiscard]] int place(const char* name) const;

    unsigned program_;
};

/// Programs compiled on first use.
class ProgramSet {
public:
    /// \param defines as of make_program
    /// \throw GpuUnavailable if a shader does not compile
    Uniforms use(const std::string& vertex, const std::string& fragment,
                 const std::string& defines = "");

private:
    std::map<std::string, Program> programs_;
};

}  // namespace vesselbench
