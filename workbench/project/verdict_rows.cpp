#include "workbench/project/verdict_rows.h"

#include "geometry/kernel/errors.h"
#include "workbench/project/compression.h"
#include "workbench/project/schema.h"
#include "workbench/project/stored_text.h"
#include "workbench/project/utc_time.h"

namespace vesselbench {

bool insert_verdicts(const Database& database, const StoredVerdicts& verdicts,
                     const std::string& hash, NewEntry entry) {
    {
        Statement known = database.prepare("SELECT 1 FROM verdicts WHERE hash = ?");
        if (known.bind(0, hash).step()) return false;
    }
    const std::string time = utc_now();
    const Bytes packed = pack_text(verdicts.text);
    database.prepare("INSERT INTO verdicts(hash, time, content) VALUES(?, ?, ?)")
        .bind(0, hash)
        .bind(1, time)
        .bind(2, packed)
        .step();
    const std::string last = "id = (SELECT max(id) FROM verdicts)";
    add_row_digests(database, "verdicts", last, entry.rows);
    if (!verdicts.signature.empty()) {
        database.prepare("INSERT INTO meta VALUES('signature ' || ?, ?)")
            .bind(0, hash)
            .bind(1, verdicts.signature)
            .step();
        add_row_digests(database, "meta",
                        "name = (SELECT 'signature ' || hash FROM verdicts WHERE " + last + ")",
                        entry.rows);
    }
    append_entry(database, entry);
    return true;
}

std::vector<StoredVerdicts> read_verdicts(const Database& database) {
    constexpr std::uint64_t kLargestTexts = std::uint64_t{32} << 20;  // [bytes]
    constexpr std::uint64_t kRatio = 250;  // texts compress less than arrays
    std::vector<StoredVerdicts> list;
    std::uint64_t size = 0;
    if (lacks_record(database)) return list;
    for (auto row = database.prepare(
             "SELECT verdicts.content, coalesce(meta.value, ''), verdicts.time FROM verdicts"
             " LEFT JOIN meta ON meta.name = 'signature ' || verdicts.hash ORDER BY verdicts.id");
         row.step();) {
        if (row.blob(1).size() > kLargestSignature)
            throw InvalidInput("a stored signature is longer than any");
        list.push_back({unpack_text(row.blob(0)), row.text(1), row.text(2)});
        size += list.back().text.size() + list.back().signature.size();
        require_plausible(size, database.bytes(), kLargestTexts, kRatio);
    }
    return list;
}

}  // namespace vesselbench
