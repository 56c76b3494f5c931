// Projects of earlier versions, which store the records of an edit as flat lists of their values.

#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/case/json_text.h"
#include "workbench/operations/table.h"
#include "workbench/project/database.h"
#include "workbench/project/stored_text.h"
#include "workbench/report/log_json.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Json = nlohmann::ordered_json;

SessionOptions options() {
    SessionOptions made{.find = find_operation};
    made.worker.command = {program_path(), "--worker"};
    return made;
}

/// Numbers, or if a field is a text, "kind:name" of each record.
Value flat(const Parameter& parameter, const Records& records) {
    std::vector<double> numbers;
    std::string text;
    bool has_text = false;
    for (const Arguments& record : records.list())
        for (const Parameter& field : parameter.fields) {
            const bool first = &field == &parameter.fields.front();
            text += (text.empty() ? ""
                     : first      ? ","
                                  : ":") +
                    to_text(record.values().at(field.name));
            has_text = has_text || field.type == ParameterType::Text;
            if (field.type == ParameterType::Point)
                for (const double part : record.point(field.name)) numbers.push_back(part);
            if (field.type == ParameterType::Real) numbers.push_back(record.real(field.name));
            if (field.type == ParameterType::Choice)
                numbers.push_back(
                    static_cast<double>(std::ranges::find(field.choices, record.text(field.name)) -
                                        field.choices.begin()));
        }
    return has_text ? Value(text) : Value(numbers);
}

/// \param count of the records' parameters
std::string flattened(const Operation& operation, const std::string& stored, int& count) {
    Arguments arguments = arguments_from_stored(stored);
    for (const Parameter& parameter : operation.parameters) {
        if (parameter.type != ParameterType::Records || !arguments.has(parameter.name)) continue;
        arguments.set(parameter.name, flat(parameter, arguments.records(parameter.name)));
        ++count;
    }
    return stored_text(arguments);
}

struct StoredRow {
    std::int64_t id = 0;
    std::string operation, text;
};

std::vector<StoredRow> rows_of(const Database& database, const std::string& query) {
    std::vector<StoredRow> rows;
    for (auto row = database.prepare(query); row.step();)
        rows.push_back({row.integer(0), row.text(1), unpack_text(row.blob(2))});
    return rows;
}

void write(const Database& database, const std::string& update, std::int64_t id,
           const std::string& text) {
    const Bytes blob = pack_text(text);
    database.prepare(update).bind(0, blob).bind(1, id).step();
}

/// Stores the arguments as earlier versions did. \return how many were records
int make_older(const std::string& project) {
    const Database database(project, OpenMode::Write);
    int count = 0;
    for (const StoredRow& row : rows_of(database, "SELECT edit, operation, given FROM edits"))
        write(database, "UPDATE edits SET given = ? WHERE edit = ?", row.id,
              flattened(find_operation(row.operation), row.text, count));
    for (const StoredRow& row :
         rows_of(database,
                 "SELECT results.id, edits.operation, results.details FROM results JOIN edits"
                 " ON results.edit = edits.edit AND results.revision = edits.revision")) {
        Json details = json_from_text(row.text, "a result");
        details["resolved"] =
            flattened(find_operation(row.operation), details["resolved"].get<std::string>(), count);
        write(database, "UPDATE results SET details = ? WHERE id = ?", row.id,
              text_from_json(details));
    }
    return count;
}

Json log_of(const Session& session) {
    Json log = Json::array();
    for (const LogEntry& entry : session.log()) log.push_back(log_json(entry));
    return log;
}

/// A tube with a stroke of two dabs, whose ends are opened.
void make_case(Session& session, const std::string& folder) {
    const std::string file = folder + "/tube.vtp";
    write_surface(open_tube(2.0, 30.0, 24, 60), file);
    session.apply("load-surface", {{"file", file}});
    session.apply("brush-inflate",
                  {{"dabs", std::vector<double>{2, 0, 14, 1, 0, 0, 2, 1.5, 0.5,  1,
                                                2, 0, 15, 1, 0, 0, 2, 1.5, 0.25, 0.75}}});
    session.apply("clip-opening", {});
}

}  // namespace

SCENARIO("A project with flat lists in place of records opens, replays and is undone",
         "[workbench][records]") {
    const std::string folder = temporary_folder(), project = folder + "/case.vbench";
    Positions made;
    {
        Session session = Session::create(project, options());
        make_case(session, folder);
        made = surface_of(session.scene()).points();
    }
    const Json log = log_of(Session::open(project, options()));
    REQUIRE(make_older(project) == 4);  // given and resolved dabs, planes and names
    Session session = Session::open(project, options());
    CHECK(log_of(session) == log);
    CHECK(session.log()[1].edit.given.records("dabs").list().size() == 2);
    for (const auto& entry : session.replay()) CHECK(entry.differences.empty());
    WHEN("an edit is undone and made again") {
        session.undo();
        session.undo();
        CHECK(session.log().size() == 1);
        session.redo();
        session.redo();
        CHECK(surface_of(session.scene()).points() == made);
    }
    WHEN("the input of decided openings changes") {
        const Records planes = session.log()[2].result->resolved.records("planes");
        CHECK(planes.list().size() == 2);
        const Records dabs({session.log()[1].edit.given.records("dabs").list()[0]});
        session.change_edit(session.log()[1].edit.edit.id, {{"dabs", dabs}});
        static_cast<void>(session.scene());
        THEN("they are made where they were") {
            CHECK(session.log()[2].status == EditStatus::Done);
            CHECK(session.log()[2].result->resolved.records("planes") == planes);
        }
    }
}
