#include "geometry/formats/legacy_vtk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>

#include "geometry/formats/grid_cells.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

constexpr std::string_view kBlank = " \t\r\n\v\f";

/// Words and number blocks of a legacy file, with their position for error texts.
class Cursor {
public:
    Cursor(const std::string& bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

    std::string_view word() {
        at_ = std::min(bytes_.find_first_not_of(kBlank, at_), bytes_.size());
        const std::size_t end = std::min(bytes_.find_first_of(kBlank, at_), bytes_.size());
        const std::string_view found(bytes_.data() + at_, end - at_);
        at_ = end;
        return found;
    }

    std::string keyword() {
        std::string found(word());
        for (char& c : found) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        return found;
    }

    std::string line() {
        const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
        std::string found = bytes_.substr(at_, end - at_);
        at_ = std::min(end + 1, bytes_.size());
        if (!found.empty() && found.back() == '\r') found.pop_back();
        return found;
    }

    [[nodiscard]] bool at_end() const { return at_ >= bytes_.size(); }

    std::size_t count(const char* what) {
        const long long value = parser().parse_integer(word(), what);
        if (value < 0 || static_cast<std::size_t>(value) > bytes_.size())
            fail(std::string(what) + " is " + std::to_string(value) +
                 ", more than the file can hold: it is truncated or damaged");
        return static_cast<std::size_t>(value);
    }

    std::vector<double> numbers(std::size_t count, const std::string& type, bool binary,
                                const char* what) {
        if (count > bytes_.size() - at_) cut_off(what);  // before anything is allocated
        std::vector<double> values(count);
        if (!binary) {
            for (double& value : values) {
                const std::string_view text = word();
                if (text.empty()) cut_off(what);
                value = text == "nan" || text == "NaN" ? std::nan("")
                                                       : parser().parse_number(text, what);
            }
            return values;
        }
        line();  // the rest of the line before the block
        const std::size_t size = type_size(type);
        if (count > (bytes_.size() - at_) / size) cut_off(what);
        for (double& value : values) {
            value = big_endian(type, size);
            at_ += size;
        }
        return values;
    }

    /// Texts as VTK writes them: a line each, or in binary files behind their length.
    std::vector<std::string> texts(std::size_t count, bool binary) {
        line();  // the rest of the line before them
        std::vector<std::string> found;
        for (std::size_t i = 0; i < count && !at_end(); ++i) {
            const std::size_t length = binary ? text_length() : 0;
            if (length > bytes_.size() - at_) cut_off("text");
            found.push_back(binary ? bytes_.substr(at_, length) : line());
            at_ += length;
        }
        return found;
    }

    void skip_metadata() {
        line();
        while (!at_end())
            if (line().find_first_not_of(kBlank) == std::string::npos) return;
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InvalidInput(file_ + ", byte " + std::to_string(at_) + ": " + what);
    }

    [[noreturn]] void cut_off(const char* what) const {
        fail(std::string("the file ends where a value is expected (") + what +
             "): it is truncated; copy or download it again");
    }

private:
    /// The two highest bits of its first byte say how many bytes it has.
    std::size_t text_length() {
        constexpr std::size_t kBytes[] = {8, 4, 2, 1};
        const auto first = static_cast<unsigned char>(bytes_[at_]);
        const std::size_t size = kBytes[first >> 6U];
        if (size > bytes_.size() - at_) cut_off("text");
        std::size_t length = first & 0x3fU;
        for (std::size_t i = 1; i < size; ++i)
            length = (length << 8U) | static_cast<unsigned char>(bytes_[at_ + i]);
        at_ += size;
        return length;
    }

    [[nodiscard]] TextScanner parser() const {
        return {{}, file_ + ", byte " + std::to_string(at_)};
    }

    std::size_t type_size(const std::string& type) const {
        constexpr std::pair<const char*, std::size_t> sizes[] = {
            {"char", 1},   {"unsigned_char", 1}, {"short", 2},         {"unsigned_short", 2},
            {"int", 4},    {"unsigned_int", 4},  {"float", 4},         {"long", 8},
            {"double", 8}, {"vtktypeint64", 8},  {"unsigned_long", 8}, {"vtkIdType", 4}};
        for (const auto& [name, size] : sizes)
            if (type == name) return size;
        fail("'" + type.substr(0, 40) + "' is not a supported number type");
    }

    template <class T>
    [[nodiscard]] double value_at() const {
        std::array<char, sizeof(T)> raw{};
        std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
        std::reverse(raw.begin(), raw.end());
        return static_cast<double>(std::bit_cast<T>(raw));
    }

    [[nodiscard]] double big_endian(const std::string& type, std::size_t size) const {
        const bool is_unsigned = type.rfind("unsigned", 0) == 0;
        if (type == "float") return value_at<float>();
        if (type == "double") return value_at<double>();
        if (size == 1) return is_unsigned ? value_at<std::uint8_t>() : value_at<std::int8_t>();
        if (size == 2) return is_unsigned ? value_at<std::uint16_t>() : value_at<std::int16_t>();
        if (size == 4) return is_unsigned ? value_at<std::uint32_t>() : value_at<std::int32_t>();
        return value_at<std::int64_t>();
    }

    const std::string& bytes_;
    std::string file_;
    std::size_t at_ = 0;
};

/// Polygons or strips: the beginning of each in the list of corners.
struct Cells {
    std::vector<double> offsets;
    std::vector<double> corners;

    [[nodiscard]] std::size_t count() const { return offsets.empty() ? 0 : offsets.size() - 1; }
};

class Reader {
public:
    Reader(const std::string& bytes, const std::string& file) : in_(bytes, file), file_(file) {}

    RawSurface read() {
        read_head();
        while (!in_.at_end()) {
            const std::string key = in_.keyword();
            if (key.empty()) break;
            read_section(key);
        }
        if (!has_points_) in_.fail("the file has no POINTS");
        if (is_grid_)
            make_surface_of_grid();
        else
            make_triangles();
        return std::move(raw_);
    }

private:
    void read_head() {
        const std::string first = in_.line();
        if (first.rfind("# vtk DataFile Version", 0) != 0)
            in_.fail("the file does not start with '# vtk DataFile Version'");
        new_cells_ = first.find("Version 5") != std::string::npos;
        const std::string title = in_.line();
        raw_.unit = stated_unit(title);
        raw_.axes = stated_axes(title);
        const std::string encoding = in_.keyword();
        if (encoding != "ASCII" && encoding != "BINARY") in_.fail("neither ASCII nor BINARY");
        binary_ = encoding == "BINARY";
        const std::string dataset = in_.keyword() == "DATASET" ? in_.keyword() : "";
        is_grid_ = dataset == "UNSTRUCTURED_GRID";
        if (!is_grid_ && dataset != "POLYDATA")
            in_.fail("the file contains no surface (DATASET POLYDATA or UNSTRUCTURED_GRID)");
    }

    void read_section(const std::string& key) {
        if (key == "POINTS") {
            read_points();
        } else if (key == "VERTICES" || key == "LINES") {
            other_cells_ += read_cells().count();
        } else if (key == "POLYGONS") {
            polygons_ = read_cells();
        } else if (key == "TRIANGLE_STRIPS") {
            strips_ = read_cells();
        } else if (key == "CELLS") {
            grid_ = read_cells();
        } else if (key == "CELL_TYPES") {
            types_ = in_.numbers(in_.count("number of cell types"), "int", binary_, "cell type");
        } else if (key == "POINT_DATA" || key == "CELL_DATA") {
            of_points_ = key == "POINT_DATA";
            tuples_ = in_.count("number of values");
        } else if (key == "METADATA") {
            in_.skip_metadata();
        } else if (key == "FIELD") {
            in_.word();
            const std::size_t arrays = in_.count("number of arrays");
            for (std::size_t i = 0; i < arrays; ++i) read_field_array();
        } else {
            read_array(key);
        }
    }

    void read_points() {
        const std::size_t count = in_.count("number of points");
        const std::string type(in_.word());
        const auto values = in_.numbers(3 * count, type, binary_, "point");
        for (std::size_t i = 0; i < count; ++i) {
            raw_.positions.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
            if (!raw_.positions.back().allFinite())
                in_.fail("a coordinate of point " + std::to_string(i) +
                         " is not finite; the program that wrote the file failed; export it "
                         "again");
        }
        has_points_ = true;
    }

    Cells read_cells() {
        const std::size_t count = in_.count("number of cells");
        const std::size_t size = in_.count("size of the cell list");
        Cells cells;
        if (new_cells_) {
            in_.word();  // OFFSETS
            const std::string offset_type(in_.word());
            cells.offsets = in_.numbers(count, offset_type, binary_, "cell offset");
            in_.word();  // CONNECTIVITY
            const std::string corner_type(in_.word());
            cells.corners = in_.numbers(size, corner_type, binary_, "cell corner");
        } else {
            const auto list = in_.numbers(size, "int", binary_, "cell");
            cells.offsets.push_back(0.0);
            for (std::size_t i = 0, cell = 0; cell < count; ++cell) {
                if (i >= list.size() || !(list[i] >= 0.0) ||
                    list[i] > static_cast<double>(list.size() - i - 1))
                    in_.fail("cell " + std::to_string(cell) + " is longer than the list of cells");
                const auto corners = static_cast<std::ptrdiff_t>(list[i]);
                const auto first = list.begin() + static_cast<std::ptrdiff_t>(i) + 1;
                cells.corners.insert(cells.corners.end(), first, first + corners);
                cells.offsets.push_back(static_cast<double>(cells.corners.size()));
                i += static_cast<std::size_t>(corners) + 1;
            }
        }
        return cells;
    }

    void read_field_array() {
        std::string name(in_.word());
        while (name == "METADATA") {
            in_.skip_metadata();
            name = std::string(in_.word());
        }
        const std::size_t components = in_.count("number of components");
        const std::size_t tuples = in_.count("number of values");
        const std::string type(in_.word());
        if (type == "string") return keep_texts(name, in_.texts(components * tuples, binary_));
        keep(name, components, in_.numbers(components * tuples, type, binary_, "array"));
    }

    void read_array(const std::string& key) {
        const std::string name(in_.word());
        std::size_t components = 1;
        if (key == "LOOKUP_TABLE") {
            const std::size_t colours = in_.count("number of colours");
            in_.numbers(4 * colours, binary_ ? "unsigned_char" : "float", binary_, "colour");
            return;
        }
        if (key == "COLOR_SCALARS") {
            components = in_.count("number of components");
            in_.numbers(components * tuples_, binary_ ? "unsigned_char" : "float", binary_,
                        "colour");
            return;
        }
        if (key == "TEXTURE_COORDINATES") components = in_.count("number of components");
        const std::string type(in_.word());
        if (key == "SCALARS")
            components = scalar_components();
        else if (key == "NORMALS" || key == "VECTORS")
            components = 3;
        else if (key == "TENSORS")
            components = 9;
        else if (key != "TEXTURE_COORDINATES")
            in_.fail("'" + key.substr(0, 40) + "' does not belong in a VTK surface");
        keep(name, components, in_.numbers(components * tuples_, type, binary_, "array"));
    }

    /// "SCALARS name type [n]" and its line "LOOKUP_TABLE name".
    std::size_t scalar_components() {
        const std::string rest = in_.line();
        const auto digit = rest.find_first_of("1234");
        if (in_.keyword() != "LOOKUP_TABLE") in_.fail("LOOKUP_TABLE is missing after SCALARS");
        in_.word();
        return digit == std::string::npos ? 1 : static_cast<std::size_t>(rest[digit] - '0');
    }

    /// 3D Slicer states the axes in such an array.
    void keep_texts(const std::string& name, const std::vector<std::string>& texts) {
        if (texts.size() != 1) return;
        if (name == "SPACE") raw_.axes = axes_named(texts.front());
        if (name == "Units") raw_.unit = unit_named(texts.front());
    }

    void keep(const std::string& name, std::size_t components, std::vector<double> values) {
        if (components != 1) return;
        if (of_points_ && values.size() == raw_.positions.size())
            raw_.attributes[name] = std::move(values);
        else if (!of_points_ && (name == "CellEntityIds" || name == kSimVascularFaces)) {
            if (name == kSimVascularFaces) raw_.usual_unit = LengthUnit::Centimetre;
            parts_ = std::move(values);
        }
    }

    void make_triangles() {
        std::size_t cell = other_cells_;
        std::vector<VertexId> corners;
        for (std::size_t i = 0; i < polygons_.count(); ++i, ++cell) {
            corners_of(polygons_, i, corners);
            if (corners.size() > 2) append_polygon(raw_.positions, corners, raw_.triangles);
            label(cell);
        }
        for (std::size_t i = 0; i < strips_.count(); ++i, ++cell) {
            corners_of(strips_, i, corners);
            for (std::size_t k = 0; k + 2 < corners.size(); ++k) {
                const std::size_t odd = k % 2;  // every second triangle is reversed
                raw_.triangles.push_back({corners[k], corners[k + 1 + odd], corners[k + 2 - odd]});
            }
            label(cell);
        }
        if (other_cells_ > 0)
            raw_.notes.push_back(std::to_string(other_cells_) +
                                 " lines or isolated points were ignored");
    }

    void make_surface_of_grid() {
        if (types_.size() != grid_.count())
            in_.fail("there are " + std::to_string(grid_.count()) + " cells, but " +
                     std::to_string(types_.size()) + " types of cells: the file is damaged");
        GridCells cells;
        std::vector<VertexId> corners;
        for (std::size_t i = 0; i < grid_.count(); ++i) {
            corners_of(grid_, i, corners);
            if (!(types_[i] >= 0.0 && types_[i] <= 255.0))
                in_.fail("cell " + std::to_string(i) + " has an unknown type");
            cells.add(static_cast<std::uint8_t>(types_[i]), corners);
        }
        if (parts_.size() == grid_.count())
            for (const double part : parts_) cells.regions.push_back(static_cast<int>(part));
        append_grid_surface(cells, file_, raw_);
    }

    void corners_of(const Cells& cells, std::size_t i, std::vector<VertexId>& corners) const {
        const double begin = cells.offsets[i], end = cells.offsets[i + 1];
        if (!(begin >= 0.0 && begin <= end && end <= static_cast<double>(cells.corners.size())))
            in_.fail("the offset of cell " + std::to_string(i) + " is out of range");
        corners.clear();
        for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
            const double v = cells.corners[k];
            if (!(v >= 0.0 && v < static_cast<double>(raw_.positions.size())))
                in_.fail("cell " + std::to_string(i) + " refers to point " +
                         std::to_string(static_cast<long long>(v)) + ", but there are only " +
                         std::to_string(raw_.positions.size()) + ": the file is damaged");
            corners.push_back(static_cast<VertexId>(v));
        }
    }

    void label(std::size_t cell) {
        if (cell < parts_.size())
            raw_.part_ids.resize(raw_.triangles.size(), static_cast<int>(parts_[cell]));
    }

    Cursor in_;
    RawSurface raw_;
    std::string file_;
    Cells polygons_, strips_, grid_;
    std::vector<double> types_;  ///< of the grid's cells
    std::vector<double> parts_;
    std::size_t other_cells_ = 0, tuples_ = 0;
    bool binary_ = false, new_cells_ = false, of_points_ = false, has_points_ = false;
    bool is_grid_ = false;
};

}  // namespace

RawSurface read_legacy_vtk(const std::string& path) {
    const std::string bytes = file_content(path);
    return Reader(bytes, bare_name(path)).read();
}

bool is_legacy_surface(std::string_view head) {
    return head.find("POLYDATA") != std::string_view::npos ||
           head.find("UNSTRUCTURED_GRID") != std::string_view::npos;
}

}  // namespace vesselbench
