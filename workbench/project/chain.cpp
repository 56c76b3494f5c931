#include "workbench/project/chain.h"

#include <array>
#include <utility>

#include <openssl/rand.h>

#include "geometry/kernel/errors.h"
#include "workbench/case/version.h"
#include "workbench/project/content_hash.h"
#include "workbench/project/utc_time.h"

namespace vesselbench {

namespace {

/// nlohmann::json sorts keys: the text of an object follows from its values.
std::string canonical(const nlohmann::json& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string meta_text(const Database& database, const std::string& name) {
    Statement query = database.prepare("SELECT value FROM meta WHERE name = ?");
    query.bind(0, name);
    return query.step() ? query.text(0) : "";
}

bool has_chain(const Database& database) {
    return database.number("SELECT count(*) FROM sqlite_master WHERE name = 'chain'") > 0;
}

void insert_entry(const Database& database, const ChainEntry& entry) {
    database.prepare("INSERT INTO chain VALUES(?, ?, ?, ?, ?, ?, ?, ?)")
        .bind(0, entry.number)
        .bind(1, entry.time)
        .bind(2, entry.kind)
        .bind(3, entry.subject)
        .bind(4, entry.author)
        .bind(5, entry.version)
        .bind(6, entry.content)
        .bind(7, entry.hash)
        .step();
    database.prepare("INSERT OR REPLACE INTO meta VALUES('chain head', ?)")
        .bind(0, entry.hash)
        .step();
}

/// Texts that are not UTF-8 (names of files) are hashed as they are stored: as replaced.
std::string utf8(const std::string& text) {
    return nlohmann::json::parse(canonical(text)).get<std::string>();
}

ChainEntry entry_in(const Statement& row) {
    constexpr std::size_t kLongest = std::size_t{64} << 20;  // [bytes]
    for (int column = 1; column < row.columns(); ++column)
        if (row.blob(column).size() > kLongest)
            throw InvalidInput("an entry of the record is longer than any that is written");
    return {row.integer(0), row.text(1), row.text(2), row.text(3),
            row.text(4),    row.text(5), row.text(6), row.text(7)};
}

}  // namespace

std::string chain_start() {
    return std::string(64, '0');
}

std::string link_of(const std::string& earlier, const ChainEntry& entry) {
    const std::string text = earlier + "\n" +
                             canonical({{"number", entry.number},
                                        {"time", entry.time},
                                        {"kind", entry.kind},
                                        {"subject", entry.subject},
                                        {"author", entry.author},
                                        {"version", entry.version},
                                        {"content", entry.content}});
    ContentHash hash;
    hash.add(std::as_bytes(std::span(text)));
    return hash.hex();
}

void append_entry(const Database& database, const NewEntry& entry) {
    ChainEntry made{.time = utc_now(),
                    .kind = entry.kind,
                    .subject = utf8(entry.subject),
                    .author = utf8(entry.author),
                    .version = version()};
    std::string earlier = chain_start();
    {
        Statement last =
            database.prepare("SELECT number, hash FROM chain ORDER BY number DESC LIMIT 1");
        if (last.step()) {
            made.number = last.integer(0);
            earlier = last.text(1);
        }
    }
    ++made.number;
    nlohmann::json content = entry.facts;
    content["rows"] = entry.rows;
    if (!entry.gone.empty()) content["gone"] = entry.gone;
    made.content = canonical(content);
    made.hash = link_of(earlier, made);
    insert_entry(database, made);
}

std::string chain_head(const Database& database) {
    if (!has_chain(database)) return "";
    Statement last = database.prepare("SELECT hash FROM chain ORDER BY number DESC LIMIT 1");
    return last.step() ? last.text(0) : "";
}

bool has_entry(const Database& database, const std::string& hash) {
    if (!has_chain(database)) return false;
    Statement found = database.prepare("SELECT 1 FROM chain WHERE hash = ?");
    found.bind(0, hash);
    return found.step();
}

std::string kept_chain_head(const Database& database) {
    return meta_text(database, "chain head");
}

std::vector<ChainEntry> read_chain(const Database& database) {
    std::vector<ChainEntry> entries;
    if (!has_chain(database)) return entries;
    for (auto row =
             database.prepare("SELECT number, time, kind, subject, author, version, content, hash"
                              " FROM chain ORDER BY number");
         row.step();)
        entries.push_back(entry_in(row));
    return entries;
}

std::string new_project_id() {
    std::array<unsigned char, 16> bytes{};
    if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1)
        throw AlgorithmFailure("the system's libcrypto offers no random numbers");
    bytes[6] = static_cast<unsigned char>((bytes[6] & 0x0f) | 0x40);  // version 4, RFC 9562
    bytes[8] = static_cast<unsigned char>((bytes[8] & 0x3f) | 0x80);
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
        text += "0123456789abcdef"[bytes[i] >> 4];
        text += "0123456789abcdef"[bytes[i] & 15];
    }
    return text;
}

std::string project_id(const Database& database) {
    return meta_text(database, "project id");
}

}  // namespace vesselbench
