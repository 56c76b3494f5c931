#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "gpu/render/view_camera.h"
#include "workbench/window/case/stored_list.h"

namespace vesselbench {

/// The camera as it was when a project was left: read when it is opened again, stored when it is
/// left. A project that cannot be written, or whose camera cannot be read, has none.
class KeptCamera {
public:
    /// \param wake as StoredList's
    explicit KeptCamera(std::function<void()> wake);

    /// As StoredList's.
    void open(const std::filesystem::path& project, const std::string& read_only);

    /// \param last stored in the project, unless it is the one that was read; none: nobody moved it
    void close(const std::optional<ViewCamera>& last);

    void update() { static_cast<void>(list_.update()); }

    /// True once it is known whether there is one.
    [[nodiscard]] bool is_read() const { return list_.is_read(); }

    [[nodiscard]] bool pending() const { return list_.pending(); }

    /// None: the project has none.
    [[nodiscard]] std::optional<ViewCamera> camera() const;

private:
    StoredList<ViewCamera> list_;  ///< of one, or none
};

}  // namespace vesselbench
