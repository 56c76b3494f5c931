#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "geometry/kernel/progress.h"

struct sqlite3;
struct sqlite3_stmt;

namespace vesselbench {

/// A prepared SQL statement; parameters and columns count from 0. Bound texts and blobs must live
/// until the last step().
class Statement {
public:
    Statement(sqlite3* database, const std::string& name, const std::string& sql);

    Statement& bind(int parameter, std::int64_t number);
    Statement& bind(int parameter, double number);
    Statement& bind(int parameter, const std::string& text);
    Statement& bind(int parameter, std::span<const std::byte> blob);

    /// Moves to the next row. \return false after the last one
    bool step();

    [[nodiscard]] bool is_null(int column) const;
    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] double real(int column) const;
    [[nodiscard]] std::string text(int column) const;
    /// The value with its type: different for different values, "i12", "t3:abc".
    [[nodiscard]] std::string exact(int column) const;
    [[nodiscard]] int columns() const;
    /// Valid until the next step().
    [[nodiscard]] std::span<const std::byte> blob(int column) const;

private:
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };

    std::string name_;
    sqlite3* database_ = nullptr;
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

enum class OpenMode {
    Create,     ///< a new file
    Write,      ///< reads and writes
    Read,       ///< beside a writer
    Frozen,     ///< a file that cannot change, in a read-only folder
    Temporary,  ///< no name; deleted on closing
};

/// An SQLite connection, which runs no triggers, views or functions of the file's schema. Failures
/// throw IoError; a damaged file, or one that is no database, InvalidInput; both name the file
/// without its folder.
class Database {
public:
    Database(const std::filesystem::path& file, OpenMode mode);

    [[nodiscard]] Statement prepare(const std::string& sql) const;
    void run(const std::string& sql) const;

    /// The first column of the first row, an integer.
    [[nodiscard]] std::int64_t number(const std::string& sql) const;

    /// Moves the write-ahead log into the file, so that the file alone is the whole database. Waits
    /// for others that read it.
    /// \return false if they do not end in time: the log is then still needed
    bool fold_log() const;

    [[nodiscard]] const std::string& name() const { return name_; }

    /// [bytes] of the file's pages.
    [[nodiscard]] std::uint64_t bytes() const;

    /// True if the file was deleted, renamed or replaced since it was opened: what is written now
    /// would be lost.
    [[nodiscard]] bool has_moved() const;

private:
    friend class Interruptible;

    struct Close {
        void operator()(sqlite3* database) const;
    };

    std::string name_;
    std::unique_ptr<sqlite3, Close> database_;
};

/// During its lifetime, a long statement ends with Cancelled as soon as the progress is cancelled.
class Interruptible {
public:
    Interruptible(const Database& database, Progress progress);
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

private:
    const Database& database_;
    Progress progress_;
};

/// A transaction: rolled back unless commit() was called.
class Transaction {
public:
    explicit Transaction(const Database& database);
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;

    void commit();

private:
    const Database& database_;
    bool open_ = true;
};

}  // namespace vesselbench
