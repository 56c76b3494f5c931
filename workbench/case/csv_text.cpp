#include "workbench/case/csv_text.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"

namespace vesselbench {

namespace {

class CsvReader {
public:
    explicit CsvReader(std::string_view text) : rest_(text) {}

    std::vector<CsvRecord> records() {
        std::vector<CsvRecord> records;
        while (!rest_.empty()) {
            CsvRecord record = next();
            if (record.fields != std::vector<std::string>{""}) records.push_back(std::move(record));
        }
        return records;
    }

private:
    CsvRecord next() {
        CsvRecord record{.line = line_, .fields = {}};
        do record.fields.push_back(take("\"") ? quoted() : plain());
        while (take(","));
        if (!take("\r\n") && !take("\n") && !take("\r") && !rest_.empty())
            refuse("a field with quotes must be in quotes as a whole, with \"\" for each \" in it");
        ++line_;
        return record;
    }

    std::string plain() {
        const std::size_t size = std::min(rest_.find_first_of(",\r\n\""), rest_.size());
        std::string field(rest_.substr(0, size));
        rest_.remove_prefix(size);
        return field;
    }

    std::string quoted() {
        const std::size_t first = line_;
        std::string field;
        while (true) {
            const std::size_t size = rest_.find('"');
            if (size == std::string_view::npos) {
                line_ = first;
                refuse("a quote is not closed");
            }
            const std::string_view part = rest_.substr(0, size);
            line_ += static_cast<std::size_t>(std::ranges::count(part, '\n'));
            field += part;
            rest_.remove_prefix(size + 1);
            if (!take("\"")) return field;
            field += '"';
        }
    }

    bool take(std::string_view text) {
        if (!rest_.starts_with(text)) return false;
        rest_.remove_prefix(text.size());
        return true;
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InvalidInput("line " + std::to_string(line_) + ": " + why);
    }

    std::string_view rest_;
    std::size_t line_ = 1;
};

}  // namespace

std::vector<CsvRecord> csv_records(std::string_view text) {
    if (!is_utf8(text) || text.find('\0') != std::string_view::npos)
        throw InvalidInput("it is not UTF-8 text: save it as CSV in UTF-8");
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    return CsvReader(text).records();
}

std::string csv_quoted(const std::string& field) {
    std::string text = "\"";
    for (const char c : field) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

}  // namespace vesselbench
