#include "workbench/flow/flow_tables.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "meshing/products/openfoam_control.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr double kCubicCentimetres = 1e6;  ///< in a cubic metre

/// The rows of a table by their iteration; a word in place of a number is not a number.
struct FlowTable {
    std::vector<std::string> columns;  ///< behind the iteration
    std::map<int, std::vector<double>> rows;
};

std::vector<std::string> row_words(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::optional<double> row_number(const std::string& word) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return number;
}

/// Adds the rows of one file. A last line without its end is still being written.
void add_table_rows(FlowTable& table, const FlowRecord& record, const std::string& text,
                    const std::string& file) {
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
        std::vector<std::string> words = row_words(text.substr(begin, end - begin));
        if (words.empty()) continue;
        if (words.front() == "#") {  // the last of the head's lines names the columns
            table.columns.assign(words.begin() + std::min<std::ptrdiff_t>(2, std::ssize(words)),
                                 words.end());
            continue;
        }
        const std::optional<double> iteration = row_number(words.front());
        if (!iteration) throw InvalidInput(file + " is not a table of OpenFOAM: it is damaged");
        std::vector<double>& row = table.rows[record.steps_until(*iteration)];
        row.clear();
        for (std::size_t k = 1; k < words.size(); ++k)
            row.push_back(row_number(words[k]).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
}

/// The files of a table: a folder for each time from which the solver was started.
std::map<double, fs::path> files_of(const fs::path& folder, const std::string& name) {
    std::map<double, fs::path> files;
    std::error_code error;
    const fs::path tables = folder / "postProcessing" / name;
    for (const auto& start : fs::directory_iterator(tables, error)) {
        const std::optional<double> time = row_number(start.path().filename().string());
        if (!time) continue;
        for (const auto& file : fs::directory_iterator(start.path(), error))
            if (file.path().extension() == ".dat") files[*time] = file.path();
    }
    return files;
}

FlowTable read_table(const fs::path& folder, const FlowRecord& record, const std::string& name) {
    FlowTable table;
    for (const auto& [start, file] : files_of(folder, name)) {
        // What an earlier run did behind this start was lost with it.
        const int last = record.steps_until(start);
        std::erase_if(table.rows, [&](const auto& row) { return row.first > last; });
        add_table_rows(table, record, file_content(file), bare_name(file));
    }
    return table;
}

/// A column of a table, for some iterations that it has.
FlowSeries table_column(const FlowTable& table, std::size_t column,
                        const std::vector<int>& iterations, double factor) {
    FlowSeries series;
    for (const int iteration : iterations) {
        const std::vector<double>& row = table.rows.at(iteration);
        series.push_back(column < row.size() ? factor * row[column]
                                             : std::numeric_limits<double>::quiet_NaN());
    }
    return series;
}

constexpr const char* kInitial = "_initial";

}  // namespace

FlowHistory flow_history(const fs::path& folder, const FlowRecord& record) {
    const FlowTable residuals = read_table(folder, record, watched_tables::kResiduals);
    const FlowTable shear =
        read_table(folder, record, watched_tables::kWallShear + record.walls.front());
    std::map<std::string, FlowTable> pressures, flows;
    std::vector<const FlowTable*> all = {&residuals, &shear};
    for (const RecordedOpening& opening : record.openings) {
        pressures[opening.name] =
            read_table(folder, record, watched_tables::kPressure + opening.name);
        flows[opening.name] = read_table(folder, record, watched_tables::kFlow + opening.name);
        all.insert(all.end(), {&pressures[opening.name], &flows[opening.name]});
    }
    FlowHistory history;
    for (const auto& [iteration, row] : residuals.rows)
        if (std::ranges::all_of(all,
                                [&](const FlowTable* t) { return t->rows.contains(iteration); }))
            history.iterations.push_back(iteration);
    for (std::size_t c = 0; c < residuals.columns.size(); ++c)
        if (const std::string& name = residuals.columns[c]; name.ends_with(kInitial))
            history.residuals[name.substr(0, name.size() - std::string(kInitial).size())] =
                table_column(residuals, c, history.iterations, 1.0);
    for (const RecordedOpening& opening : record.openings) {
        history.pressures[opening.name] =
            table_column(pressures[opening.name], 0, history.iterations, record.density);
        history.flows[opening.name] =
            table_column(flows[opening.name], 0, history.iterations, kCubicCentimetres);
    }
    history.wall_shear = table_column(shear, 0, history.iterations, record.density);
    return history;
}

}  // namespace vesselbench
