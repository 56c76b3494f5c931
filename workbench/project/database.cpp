#include "workbench/project/database.h"

#include <bit>
#include <fstream>
#include <utility>

#include <sqlite3.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

// Another process may briefly be writing or checkpointing.
constexpr int kPatienceMilliseconds = 10000;

[[noreturn]] void fail(sqlite3* database, const std::string& name) {
    const int code = database != nullptr ? sqlite3_errcode(database) : SQLITE_NOMEM;
    const std::string why = database != nullptr ? sqlite3_errmsg(database) : "out of memory";
    switch (code) {
        case SQLITE_INTERRUPT:
            throw Cancelled();
        case SQLITE_NOTADB:
            throw InvalidInput(name + " is not a vesselbench project");
        case SQLITE_CORRUPT:
        case SQLITE_ERROR:
        case SQLITE_MISMATCH:
        case SQLITE_FORMAT:
            throw InvalidInput(name + " is damaged (" + why + "); use a copy of it");
        case SQLITE_FULL:
            throw IoError(
                "cannot write " + name +
                ": the disk is full. The project is unchanged; free some space and try again");
        case SQLITE_IOERR:
            throw IoError(
                "cannot read or write " + name + " (" + why +
                "): the disk or your quota is full, files may not be that large here "
                "(ulimit -f), or the disk is failing. The project is unchanged; free some "
                "space or raise the limit, and try again");
        case SQLITE_READONLY:
        case SQLITE_PERM:
            throw IoError("cannot write " + name + ": no permission");
        default:
            throw IoError("cannot use " + name + ": " + why);
    }
}

int flags_of(OpenMode mode) {
    switch (mode) {
        case OpenMode::Create:
        case OpenMode::Temporary:
            return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
        case OpenMode::Write:
        case OpenMode::Read:
            return SQLITE_OPEN_READWRITE;
        case OpenMode::Frozen:
            break;
    }
    return SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
}

/// The file's name in SQLite's form.
std::string address_of(const std::filesystem::path& file, OpenMode mode) {
    if (mode == OpenMode::Temporary) return "";
    const std::string path = std::filesystem::absolute(file).string();
    if (mode != OpenMode::Frozen) return path;
    std::string address = "file:";
    for (const char c : path) {
        const bool reserved = c == '?' || c == '#' || c == '%';
        address += reserved ? std::string("%") + (c == '?'   ? "3f"
                                                  : c == '#' ? "23"
                                                             : "25")
                            : std::string(1, c);
    }
    return address + "?immutable=1";
}

/// SQLite would give a new file no more permissions than 644, whatever the umask allows.
void create_empty(const std::filesystem::path& file) {
    std::ofstream(file, std::ios::app);  // where it fails, SQLite says why
}

/// A file from a stranger must not make SQLite do anything but read and write rows.
void restrict(sqlite3* database) {
    for (const auto& [option, value] :
         {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1), std::pair(SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0),
          std::pair(SQLITE_DBCONFIG_ENABLE_TRIGGER, 0), std::pair(SQLITE_DBCONFIG_ENABLE_VIEW, 0),
          std::pair(SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0)})
        sqlite3_db_config(database, option, value, nullptr);
    constexpr int kLongestValue = 1 << 30;  // [bytes] of a blob or text
    sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kLongestValue);
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

Statement::Statement(sqlite3* database, const std::string& name, const std::string& sql)
    : name_(name), database_(database) {
    sqlite3_stmt* made = nullptr;
    const int code = sqlite3_prepare_v2(database, sql.c_str(), -1, &made, nullptr);
    statement_.reset(made);
    if (code != SQLITE_OK) fail(database_, name_);
}

Statement& Statement::bind(int parameter, std::int64_t number) {
    if (sqlite3_bind_int64(statement_.get(), parameter + 1, number) != SQLITE_OK)
        fail(database_, name_);
    return *this;
}

Statement& Statement::bind(int parameter, double number) {
    if (sqlite3_bind_double(statement_.get(), parameter + 1, number) != SQLITE_OK)
        fail(database_, name_);
    return *this;
}

Statement& Statement::bind(int parameter, const std::string& text) {
    if (sqlite3_bind_text64(statement_.get(), parameter + 1, text.data(), text.size(),
                            SQLITE_STATIC, SQLITE_UTF8) != SQLITE_OK)
        fail(database_, name_);
    return *this;
}

Statement& Statement::bind(int parameter, std::span<const std::byte> blob) {
    if (sqlite3_bind_blob64(statement_.get(), parameter + 1, blob.data(), blob.size(),
                            SQLITE_STATIC) != SQLITE_OK)
        fail(database_, name_);
    return *this;
}

bool Statement::step() {
    const int code = sqlite3_step(statement_.get());
    if (code != SQLITE_ROW && code != SQLITE_DONE) fail(database_, name_);
    return code == SQLITE_ROW;
}

bool Statement::is_null(int column) const {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::int64_t Statement::integer(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}

double Statement::real(int column) const {
    return sqlite3_column_double(statement_.get(), column);
}

std::string Statement::text(int column) const {
    const auto bytes = blob(column);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string Statement::exact(int column) const {
    switch (sqlite3_column_type(statement_.get(), column)) {
        case SQLITE_INTEGER:
            return "i" + std::to_string(integer(column)) + ";";
        case SQLITE_FLOAT:
            return "r" + std::to_string(std::bit_cast<std::uint64_t>(real(column))) + ";";
        case SQLITE_NULL:
            return "n;";
        case SQLITE_TEXT:
            return "t" + std::to_string(blob(column).size()) + ":" + text(column) + ";";
        default:
            return "b" + std::to_string(blob(column).size()) + ":" + text(column) + ";";
    }
}

int Statement::columns() const {
    return sqlite3_column_count(statement_.get());
}

std::span<const std::byte> Statement::blob(int column) const {
    const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), column));
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

void Database::Close::operator()(sqlite3* database) const {
    sqlite3_close(database);
}

Database::Database(const std::filesystem::path& file, OpenMode mode)
    : name_(mode == OpenMode::Temporary ? "the unsaved project" : file.filename().string()) {
    if (mode == OpenMode::Create) create_empty(file);
    sqlite3* opened = nullptr;
    const int code =
        sqlite3_open_v2(address_of(file, mode).c_str(), &opened, flags_of(mode), nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) fail(opened, name_);
    sqlite3_busy_timeout(opened, kPatienceMilliseconds);
    restrict(opened);
    run("PRAGMA cell_size_check = ON");  // notices damaged pages before they are used
    if (mode == OpenMode::Read || mode == OpenMode::Frozen) run("PRAGMA query_only = ON");
}

Statement Database::prepare(const std::string& sql) const {
    return Statement(database_.get(), name_, sql);
}

void Database::run(const std::string& sql) const {
    if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        fail(database_.get(), name_);
}

std::int64_t Database::number(const std::string& sql) const {
    Statement statement = prepare(sql);
    if (!statement.step()) throw InvalidInput(name_ + " is damaged: a value is missing");
    return statement.integer(0);
}

bool Database::fold_log() const {
    Statement fold = prepare("PRAGMA wal_checkpoint(TRUNCATE)");
    fold.step();
    const bool busy = fold.integer(0) != 0;
    const auto pages = fold.integer(1), moved = fold.integer(2);  // -1: not even looked at
    return !busy || (pages >= 0 && moved == pages);
}

std::uint64_t Database::bytes() const {
    return static_cast<std::uint64_t>(number("PRAGMA page_count") * number("PRAGMA page_size"));
}

bool Database::has_moved() const {
    int moved = 0;
    return sqlite3_file_control(database_.get(), "main", SQLITE_FCNTL_HAS_MOVED, &moved) ==
               SQLITE_OK &&
           moved != 0;
}

Interruptible::Interruptible(const Database& database, Progress progress)
    : database_(database), progress_(std::move(progress)) {
    constexpr int kInstructions = 1000;  // of SQLite's machine: well below a millisecond
    sqlite3_progress_handler(
        database_.database_.get(), kInstructions,
        [](void* self) {
            try {
                static_cast<const Interruptible*>(self)->progress_.check_cancelled();
                return 0;
            } catch (const Cancelled&) {
                return 1;
            }
        },
        this);
}

Interruptible::~Interruptible() {
    sqlite3_progress_handler(database_.database_.get(), 0, nullptr, nullptr);
}

Transaction::Transaction(const Database& database) : database_(database) {
    database_.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
    if (!open_) return;
    try {
        database_.run("ROLLBACK");
    } catch (const std::exception&) {
        // SQLite has already rolled back if a write failed.
    }
}

void Transaction::commit() {
    database_.run("COMMIT");
    open_ = false;
}

}  // namespace vesselbench
