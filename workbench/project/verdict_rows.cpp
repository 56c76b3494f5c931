#include "workbench/project/verdict_rows.h"

#include "workbench/project/compression.h"
#include "workbench/project/schema.h"
#include "workbench/project/stored_text.h"
#include "workbench/project/utc_time.h"

namespace vesselbench {

bool insert_verdicts(const Database& database, const std::string& text, const std::string& hash,
                     NewEntry entry) {
    {
        Statement known = database.prepare("SELECT 1 FROM verdicts WHERE hash = ?");
        if (known.bind(0, hash).step()) return false;
    }
    const std::string time = utc_now();
    const Bytes packed = pack_text(text);
    database.prepare("INSERT INTO verdicts(hash, time, content) VALUES(?, ?, ?)")
        .bind(0, hash)
        .bind(1, time)
        .bind(2, packed)
        .step();
    add_row_digests(database, "verdicts", "id = (SELECT max(id) FROM verdicts)", entry.rows);
    append_entry(database, entry);
    return true;
}

std::vector<std::string> read_verdicts(const Database& database) {
    constexpr std::uint64_t kLargestTexts = std::uint64_t{32} << 20;  // [bytes]
    constexpr std::uint64_t kRatio = 250;  // texts compress less than arrays
    std::vector<std::string> texts;
    std::uint64_t size = 0;
    if (lacks_record(database)) return texts;
    for (auto row = database.prepare("SELECT content FROM verdicts ORDER BY id"); row.step();) {
        texts.push_back(unpack_text(row.blob(0)));
        size += texts.back().size();
        require_plausible(size, database.bytes(), kLargestTexts, kRatio);
    }
    return texts;
}

}  // namespace vesselbench
