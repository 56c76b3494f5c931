#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/formats/length_unit.h"
#include "geometry/formats/patient_axes.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A surface as stored in a file: in the file's unit, with only indices and finiteness checked.
/// Shared by the readers of this folder.
struct RawSurface {
    Positions positions;
    std::vector<Triangle> triangles;
    std::vector<int> part_ids;              ///< per triangle, or empty: all one part
    std::map<int, std::string> part_names;  ///< by part id; some parts may have none
    std::map<std::string, std::vector<double>> attributes;  ///< each #V
    std::optional<LengthUnit> unit;                         ///< if the file states it
    std::optional<LengthUnit> usual_unit;                   ///< of the program that wrote the file
    std::optional<PatientAxes> axes;                        ///< if the file states them
    std::vector<std::string> notes;                         ///< ignored data, for the report
};

/// Numbers of a model's faces, which SimVascular writes; its models are usually in cm.
inline constexpr const char* kSimVascularFaces = "ModelFaceID";

/// The unit after "UNITS=" in a header or comment, if it is a known one.
[[nodiscard]] std::optional<LengthUnit> stated_unit(std::string_view text);

/// Appends the triangles of a polygon (3 or more corners, any shape without self-crossings, nearly
/// flat); their number `count` is corners - 2.
void append_polygon(const Positions& positions, const std::vector<VertexId>& polygon,
                    std::vector<Triangle>& triangles);

/// Scans a text, counting lines; every error names the file and the line.
class TextScanner {
public:
    TextScanner(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

    /// Moves to the next line with a word outside comments (`comment`: their first character);
    /// false at the end of the text.
    bool next_line(char comment);

    /// The next word of this line; empty at its end.
    std::string_view word();

    /// The next word of this line as a finite number, or an error that names `what`.
    double number(const char* what);

    /// The same for an integer.
    long long integer(const char* what);

    [[nodiscard]] std::size_t line() const { return line_; }

    /// The current line without its line ending.
    [[nodiscard]] std::string_view whole_line() const { return current_; }

    [[noreturn]] void fail(const std::string& what) const;

    double parse_number(std::string_view text, const char* what) const;
    long long parse_integer(std::string_view text, const char* what) const;

private:
    std::string_view rest_, current_, words_;
    std::string file_;
    std::size_t line_ = 0;
};

}  // namespace vesselbench
