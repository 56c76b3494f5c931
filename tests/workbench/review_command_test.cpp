#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/beginning.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/signing.h"
#include "workbench/project/database.h"
#include "workbench/project/project.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace {

Json json_of(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    return Json::parse(run(arguments).out);
}

/// A project with a sphere that was smoothed.
std::string new_project(const std::string& folder) {
    write_surface(icosphere(10.0, 2), folder + "/ball.stl");
    REQUIRE(run({"new", folder + "/p.vbench", folder + "/ball.stl", "--units", "mm"}).exit_code ==
            0);
    REQUIRE(run({"apply", folder + "/p.vbench", "smooth", "--author", "Ada"}).exit_code == 0);
    return folder + "/p.vbench";
}

/// What a reviewer saves who judges every edit alike.
std::string verdicts(const std::string& project, const std::string& reviewer,
                     const std::string& verdict, const std::string& to) {
    const Json review = json_of({"review", project});
    Json edits = Json::array();
    for (const Json& edit : review["edits"])
        edits.push_back({{"edit", edit["edit"]},
                         {"revision", edit["revision"]},
                         {"hash", edit["hash"]},
                         {"verdict", verdict},
                         {"comment", "because"},
                         {"time", "2020-01-01T00:00:00Z"},
                         {"pins", Json::array()},
                         {"distances", Json::array()}});
    const Json file = {{"format", "vesselbench-verdicts"},
                       {"version", 1},
                       {"program", "test"},
                       {"project", {{"id", review["id"]}, {"name", "p"}}},
                       {"chain_head", review["head"]},
                       {"reviewer", {{"name", reviewer}, {"role", "radiologist"}}},
                       {"written", "2020-01-01T00:00:00Z"},
                       {"overall", {{"verdict", "none"}, {"comment", ""}}},
                       {"edits", edits}};
    write_file(to, file.dump());
    return to;
}

}  // namespace

SCENARIO("An export can require that reviewers have accepted the model",
         "[workbench][command-line][review]") {
    static const Beginning beginning([](const std::string& folder) {
        const std::string project = new_project(folder), file = folder + "/out.stl";
        const std::vector<std::string> gated = {"export", project, file, "--require", "accepted"};
        const ProgramRun refused = run(gated);
        CHECK(refused.exit_code == 1);
        CHECK_THAT(refused.err, Contains("1 load-surface (open)") && Contains("2 smooth (open)"));
        CHECK_FALSE(std::filesystem::exists(file));
        CHECK(json_of(gated)["diagnostics"][0]["code"] == "not-accepted");
        const std::string kern = verdicts(project, "A. Kern", "accept", folder + "/kern.json");
        const ProgramRun entered = run({"review", project, "--import", kern});
        CHECK(entered.exit_code == 0);
        CHECK_THAT(entered.out, Contains("accepted by A. Kern"));
        CHECK_THAT(run({"review", project, "--import", kern}).err, Contains("entered already"));
        return std::tuple(project, gated, kern);
    });
    const auto& [project, gated, kern] = beginning.again();
    const std::string& folder = beginning.folder();
    THEN("it is written then, and the record says so") {
        CHECK(run(gated).exit_code == 0);
        CHECK(std::filesystem::exists(folder + "/out.stl"));
        const Json audit = json_of({"audit", project, "--against", kern});
        CHECK(audit["verified"] == true);
        CHECK(audit["entries"].back()["kind"] == "export");
        CHECK(audit["entries"].back()["subject"] == "out.stl");
        CHECK(audit["statement"]["review"] == "accepted by A. Kern");
        CHECK(audit["statement"]["reviewers"][0]["name"] == "A. Kern");
        CHECK(audit["statement"]["sources"][0]["file"] == "ball.stl");
        CHECK_THAT(audit.dump(), !Contains(folder));
    }
    THEN("an export that cannot be recorded says so, and is refused where it has to be") {
        const ProjectFile writer = ProjectFile::open(project);
        const ProgramRun said = run({"export", project, folder + "/other.stl"});
        CHECK(said.exit_code == 0);
        CHECK_THAT(said.err, Contains("the export is not recorded"));
        const ProgramRun refused = run(gated);
        CHECK(refused.exit_code == 1);
        CHECK_THAT(refused.err, Contains("only where the record can say so"));
        CHECK_FALSE(std::filesystem::exists(folder + "/out.stl"));
    }
    THEN("two reviewers may be asked for") {
        const ProgramRun two =
            run({"export", project, folder + "/out.stl", "--require", "accepted=2"});
        CHECK(two.exit_code == 1);
        CHECK_THAT(two.err, Contains("2 smooth (accepted by 1 of 2)"));
    }
    THEN("two reviewers who disagree leave it disputed") {
        const std::string roth = verdicts(project, "B. Roth", "reject", folder + "/roth.json");
        CHECK(run({"review", project, "--import", roth}).exit_code == 0);
        CHECK(json_of({"review", project})["status"] == "disputed");
        const ProgramRun refused = run(gated);
        CHECK(refused.exit_code == 1);
        CHECK_THAT(refused.err, Contains("2 smooth (disputed)"));
    }
    THEN("a change of an edit makes its verdict outdated") {
        REQUIRE(run({"change", project, "2", "iterations=3"}).exit_code == 0);
        CHECK(json_of({"review", project})["edits"][1]["status"] == "outdated");
        CHECK(run(gated).exit_code == 1);
    }
    THEN("wrong words are wrong usage") {
        for (const char* word : {"accept", "accepted=", "accepted=0", "accepted=x", "accepted=2x"})
            CHECK(run({"export", project, folder + "/out.stl", "--require", word}).exit_code == 2);
    }
}

SCENARIO("An owner who changes the project's file does not pass the gate",
         "[workbench][command-line][review][hostile]") {
    static const Beginning beginning([](const std::string& folder) {
        const std::string project = new_project(folder);
        const std::string kern = verdicts(project, "A. Kern", "accept", folder + "/kern.json");
        REQUIRE(run({"review", project, "--import", kern}).exit_code == 0);
        const std::string accepted = folder + "/accepted.vbench";
        std::filesystem::copy_file(project, accepted);
        const std::string roth = verdicts(project, "B. Roth", "reject", folder + "/roth.json");
        REQUIRE(run({"review", project, "--import", roth}).exit_code == 0);
        return std::pair(project, accepted);
    });
    const auto& [rejected, accepted] = beginning.again();
    const std::string file = beginning.folder() + "/out.stl";
    const auto exported = [&](const std::string& project, std::vector<std::string> more) {
        std::vector<std::string> command = {"export", project, file};
        command.insert(command.end(), more.begin(), more.end());
        return run(command);
    };
    const auto changed = [&](const std::string& project, const char* sql) {
        const std::string copy = project + ".copy.vbench";
        std::filesystem::copy_file(project, copy,
                                   std::filesystem::copy_options::overwrite_existing);
        Database(copy, OpenMode::Write).run(sql);
        return copy;
    };
    THEN("what was rejected stays so, whatever rows are deleted or altered") {
        for (const char* sql : {
                 "DELETE FROM verdicts WHERE id = 2",
                 "DELETE FROM verdicts WHERE id = 2; DELETE FROM chain WHERE number ="
                 " (SELECT max(number) FROM chain)",
                 "UPDATE verdicts SET content = (SELECT content FROM verdicts WHERE id = 1)"
                 " WHERE id = 2",
                 "UPDATE chain SET kind = 'note' WHERE kind = 'verdicts'",
             }) {
            INFO(sql);
            const ProgramRun refused = exported(changed(rejected, sql), {"--require", "accepted"});
            CHECK(refused.exit_code == 1);
            CHECK_THAT(refused.err, Contains("not what its record says"));
            CHECK_FALSE(std::filesystem::exists(file));
        }
    }
    THEN("an accepted model is no other surface, variant or edit") {
        CHECK(exported(accepted, {"--require", "accepted"}).exit_code == 0);
        std::filesystem::remove(file);
        for (const char* sql : {"UPDATE edits SET author = 'Eve'",
                                "UPDATE edits SET given = (SELECT given FROM edits WHERE edit = 1)"
                                " WHERE edit = 2",
                                "UPDATE results SET scene = (SELECT scene FROM results LIMIT 1)"}) {
            INFO(sql);
            CHECK(exported(changed(accepted, sql), {"--require", "accepted"}).exit_code != 0);
            CHECK_FALSE(std::filesystem::exists(file));
        }
        const ProgramRun other =
            exported(accepted, {"--require", "accepted", "--variant", "nobody-saw-it"});
        CHECK(other.exit_code == 2);
        CHECK_THAT(other.err, Contains("has no variant 'nobody-saw-it'"));
        CHECK_FALSE(std::filesystem::exists(file));
    }
    THEN("one person is not two reviewers") {
        for (const char* name : {"a. KERN ", "A Kern", "A.\u00a0Kern", "\u0410. Kern"}) {
            const std::string copy = changed(accepted, "SELECT 1");
            const std::string again =
                verdicts(copy, name, "accept", beginning.folder() + "/again.json");
            run({"review", copy, "--import", again});
            CHECK(exported(copy, {"--require", "accepted=2"}).exit_code == 1);
            CHECK_FALSE(std::filesystem::exists(file));
        }
    }
}

SCENARIO("The agreement of reviewers is printed over several projects",
         "[workbench][command-line][review]") {
    static const Beginning beginning([](const std::string& folder) {
        std::filesystem::create_directory(folder + "/other");
        const std::string project = new_project(folder), other = new_project(folder + "/other");
        for (const std::string& judged : {project, other})
            for (const char* reviewer : {"A. Kern", "B. Roth"})
                REQUIRE(run({"review", judged, "--import",
                             verdicts(judged, reviewer, "accept", folder + "/v.json")})
                            .exit_code == 0);
        const ProgramRun good = run({"review", "--summary", project, other});
        CHECK(good.exit_code == 0);
        CHECK_THAT(good.out, Contains("2 projects, 2 reviewers: A. Kern, B. Roth") &&
                                 Contains("load-surface") && Contains("too few"));
        const Json json = json_of({"review", project, "--summary"});
        CHECK(json["all"]["edits"] == 2);
        CHECK(json["all"]["share"] == 1.0);
        return std::pair(project, other);
    });
    const auto& [project, other] = beginning.again();
    const std::string& folder = beginning.folder();
    THEN("what cannot be read is named, and the others are counted") {
        write_file(folder + "/damaged.vbench", "damaged");
        const std::vector<std::string> mixed = {"review", "--summary", folder + "/damaged.vbench",
                                                project};
        const ProgramRun bad = run(mixed);
        CHECK(bad.exit_code == 3);
        CHECK_THAT(bad.err, Contains(folder + "/damaged.vbench"));
        CHECK_THAT(bad.out, Contains("1 project, 2 reviewers"));
        CHECK(json_of(mixed)["unread"][0]["project"] == folder + "/damaged.vbench");
        CHECK(json_of(mixed)["all"]["edits"] == 2);
    }
    THEN("it goes with nothing else, and everything else with one project") {
        CHECK(run({"review", project, other}).exit_code == 2);
        CHECK(run({"review", "--summary"}).exit_code == 2);
        CHECK(run({"review", "--summary", project, "--import", folder + "/v.json"}).exit_code == 2);
        const std::string file = verdicts(project, "A. Kern", "accept", folder + "/v.json");
        CHECK(run({"review", project, "--import", file, file}).exit_code == 0);
    }
}

SCENARIO("Signed verdicts are verified against allowed signers",
         "[workbench][command-line][review]") {
    if (!can_sign()) return;
    static const Beginning beginning([](const std::string& folder) {
        const std::string project = new_project(folder), key = new_signing_key(),
                          signers = allowed_signers(allowed_line("kern@clinic.example", key)),
                          others = allowed_signers(allowed_line("roth", new_signing_key()));
        const std::string kern = verdicts(project, "A. Kern", "accept", folder + "/kern.json");
        const auto import_with = [&](const std::string& allowed) {
            return run({"review", project, "--import", kern, "--signers", allowed});
        };
        ProgramRun refused = import_with(signers);
        CHECK(refused.exit_code == 3);
        CHECK_THAT(refused.err, Contains("kern.json is not signed"));
        sign(kern, key);
        refused = import_with(others);
        CHECK(refused.exit_code == 3);
        CHECK_THAT(refused.err, Contains("its signature does not verify"));
        CHECK(json_of({"review", project})["files"] == 0);
        return std::tuple(project, kern, signers, others);
    });
    const auto& [project, kern, signers, others] = beginning.again();
    const std::string& folder = beginning.folder();
    const std::vector<std::string> entering = {"review", project,     "--import",
                                               kern,     "--signers", signers};
    WHEN("they are entered with their signature") {
        CHECK_THAT(run(entering).out, Contains("A. Kern (signed by kern@clinic.example): accept"));
        CHECK_THAT(run({"review", project}).out, Contains("A. Kern (signed, not verified)"));
        CHECK_THAT(run({"audit", project}).out, Contains("signed, not verified"));
        const ProgramRun good = run({"audit", project, "--signers", signers});
        CHECK(good.exit_code == 0);
        CHECK_THAT(good.out, Contains("A. Kern (radiologist), signed by kern@clinic.example"));
        const std::vector<std::string> by_others = {"audit", project, "--signers", others};
        CHECK(run(by_others).exit_code == 1);
        CHECK(json_of(by_others)["diagnostics"][0]["code"] == "signature-invalid");
        CHECK(run({"audit", project, "--signers", folder + "/none"}).exit_code == 3);
    }
    WHEN("the key is lost") {
        REQUIRE(run(entering).exit_code == 0);
        const Json keys = json_of({"review", project, "--signers", signers})["keys"];
        REQUIRE(keys.size() == 1);
        const auto key = keys[0]["fingerprint"].get<std::string>();
        CHECK(run({"review", project, "--retire-key", key}).exit_code == 2);
        CHECK(run({"review", project, "--retire-key", "kern", "--reason", "lost"}).exit_code == 2);
        const ProgramRun retired =
            run({"review", project, "--retire-key", key, "--reason", "lost"});
        CHECK(retired.exit_code == 0);
        CHECK_THAT(retired.out, Contains("key " + key + ": A. Kern, 1 file, retired on"));
        CHECK(json_of({"audit", project})["entries"].back()["kind"] == "key-retired");
    }
    WHEN("there is no ssh-keygen, it is named, and nothing is entered") {
        const ProgramRun without = run_program(program_path(), entering, "PATH=/nowhere");
        CHECK(without.exit_code == 3);
        CHECK_THAT(without.err, Contains("ssh-keygen") && Contains("openssh-client"));
        CHECK(json_of({"review", project})["files"] == 0);
    }
}

SCENARIO("A recipe can require that reviewers have accepted the model",
         "[workbench][command-line][review][prepare]") {
    static const Beginning beginning([](const std::string& folder) {
        write_surface(closed_tube(2.0, 20.0, 24, 40), folder + "/tube.vtp");
        write_file(folder + "/gated.json", R"([{"operation": "repair"}, {"require": "accepted"}])");
        const std::vector<std::string> command = {
            "prepare",  folder + "/tube.vtp",   "--for", "planning",
            "--recipe", folder + "/gated.json", "--out", folder + "/out"};
        return std::pair(command, run(command));
    });
    auto [prepare, first] = beginning.again();
    const std::string folder = beginning.folder(), out = folder + "/out";
    CHECK(first.exit_code == 1);
    CHECK_THAT(first.err, Contains("1 load-surface (open), 2 repair (open)"));
    CHECK(std::filesystem::exists(out + "/project.vbench"));
    CHECK_FALSE(std::filesystem::exists(out + "/surface.stl"));
    const Json stopped = Json::parse(file_content(out + "/report.json"));
    CHECK(stopped["stopped"]["diagnostics"][0]["code"] == "not-accepted");
    const bool has_page = first.err.find("was built without npm") == std::string::npos;
    CHECK(std::filesystem::exists(out + "/review.html") == has_page);
    prepare.emplace_back("--resume");
    THEN("resuming asks again, also without the recipe, and keeps no older page") {
        CHECK(run(prepare).exit_code == 1);
        CHECK_FALSE(std::filesystem::exists(out + "/review.1.html"));
        CHECK(run({"prepare", folder + "/tube.vtp", "--for", "planning", "--out", out, "--resume"})
                  .exit_code == 1);
        CHECK_FALSE(std::filesystem::exists(out + "/surface.stl"));
    }
    THEN("the products are written once it is accepted, and say so") {
        const std::string project = out + "/project.vbench";
        const std::string kern = verdicts(project, "A. Kern", "accept", folder + "/kern.json");
        REQUIRE(run({"review", project, "--import", kern}).exit_code == 0);
        const ProgramRun done = run(prepare);
        INFO(done.err);
        REQUIRE(done.exit_code == 0);
        const std::string header = file_content(out + "/surface.stl").substr(0, 80);
        CHECK_THAT(header, Contains("UNITS=mm, project tube, planning, accepted by A. Kern"));
        CHECK_THAT(file_content(out + "/surface.vtp"), Contains("accepted by A. Kern"));
        const Json report = Json::parse(file_content(out + "/report.json"));
        CHECK(report["review"]["state"] == "accepted by A. Kern");
    }
    THEN("an owner who deletes the number of reviewers is not done either") {
        Database(out + "/project.vbench", OpenMode::Write)
            .run("DELETE FROM meta WHERE name = 'acceptance'");
        const ProgramRun refused =
            run({"prepare", folder + "/tube.vtp", "--for", "planning", "--out", out, "--resume"});
        CHECK(refused.exit_code == 1);
        CHECK_THAT(refused.err, Contains("1 load-surface (open)"));
        CHECK_FALSE(std::filesystem::exists(out + "/surface.stl"));
    }
    THEN("another purpose is not asked") {
        CHECK(
            run({"prepare", folder + "/tube.vtp", "--for", "simulation", "--out", out, "--resume"})
                .exit_code == 0);
    }
}

SCENARIO("Products carry their review, and no time and no place",
         "[workbench][command-line][review][prepare]") {
    const std::string folder = temporary_folder();
    write_surface(closed_tube(2.0, 20.0, 24, 40), folder + "/tube.vtp");
    const auto prepared = [&](const std::string& out) {
        REQUIRE(
            run({"prepare", folder + "/tube.vtp", "--for", "planning", "--out", out}).exit_code ==
            0);
        return file_content(out + "/surface.vtp");
    };
    const std::string once = prepared(folder + "/once");
    CHECK_THAT(once, Contains("not reviewed"));
    CHECK(prepared(temporary_folder() + "/elsewhere") == once);
    THEN("an export gives the same bytes again, although the record has grown") {
        for (const char* name : {"/a.vtp", "/b.vtp"})
            REQUIRE(run({"export", folder + "/once/project.vbench", folder + name}).exit_code == 0);
        CHECK(file_content(folder + "/a.vtp") == file_content(folder + "/b.vtp"));
        CHECK(file_content(folder + "/a.vtp") == once);
    }
}

SCENARIO("Verdicts that are none are bad input", "[workbench][command-line][review]") {
    const std::string folder = temporary_folder(), project = new_project(folder);
    write_file(folder + "/v.json", R"({"format": "vesselbench-verdicts", "version": 9})");
    for (const std::string& file : {folder + "/v.json", folder + "/none.json"}) {
        CHECK(run({"review", project, "--import", file}).exit_code == 3);
        CHECK(run({"audit", project, "--against", file}).exit_code == 3);
    }
    const std::string other = temporary_folder();
    const std::string foreign =
        verdicts(new_project(other), "A. Kern", "accept", folder + "/foreign.json");
    const ProgramRun refused = run({"review", project, "--import", foreign});
    CHECK(refused.exit_code == 3);
    CHECK_THAT(refused.err, Contains("foreign.json.project.id is another project's"));
}

SCENARIO("An audit fails if the project is not what its record says",
         "[workbench][command-line][review]") {
    const std::string folder = temporary_folder(), project = new_project(folder);
    const ProgramRun good = run({"audit", project, "--replay", "--html", folder + "/record.html"});
    CHECK(good.exit_code == 0);
    CHECK_THAT(good.out, Contains("smooth (smoothing, cfd)") && Contains("Ada") &&
                             Contains("cannot be verified"));
    CHECK_THAT(file_content(folder + "/record.html"), Contains("Verified.") && Contains("smooth"));
    const ProgramRun witness = run({"audit", project, "--witness"});
    CHECK(std::count(witness.out.begin(), witness.out.end(), '\n') == 1);
    write_file(folder + "/book.txt", witness.out);
    CHECK(run({"audit", project, "--against", folder + "/book.txt"}).exit_code == 0);
    std::string bytes = file_content(project);
    const std::size_t author = bytes.find("Ada");
    REQUIRE(author != std::string::npos);
    while (bytes.find("Ada") != std::string::npos) bytes.replace(bytes.find("Ada"), 3, "Eve");
    std::filesystem::remove(project);
    write_file(project, bytes);
    const ProgramRun bad = run({"audit", project});
    CHECK(bad.exit_code == 1);
    CHECK_THAT(bad.err, Contains("not what its record says"));
    CHECK_THAT(bad.out, Contains("edit 2.1 is not what entry"));
    CHECK(run({"audit", project, "--witness"}).out.empty());
    CHECK(run({"audit", folder + "/none.vbench"}).exit_code == 3);
}
