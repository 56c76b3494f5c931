// The cases of a batch, as a manifest or a folder names them.

#include "workbench/batch/manifest.h"

#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/batch/plan.h"
#include "workbench/case/csv_text.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Names = std::vector<std::string>;

namespace fs = std::filesystem;

namespace {

const CaseColumns kColumns = {
    .options = {{.name = "mask", .is_file = true},
                {.name = "units"},
                {.name = "neighbour", .repeatable = true, .is_file = true},
                {.name = "inlet", .repeatable = true},
                {.name = "set", .repeatable = true},
                {.name = "accept-doubts", .is_flag = true}},
    .shared = {}};

std::vector<BatchCase> cases_in(const std::string& text, const CaseColumns& columns = kColumns) {
    const std::string file = temporary_folder() + "/cases.csv";
    write_text(file, text);
    return cases_of_manifest(file, columns);
}

/// The only case's arguments after those that all cases have, without the manifest's folder.
Names options_in(const std::string& text, const CaseColumns& columns = kColumns) {
    const std::vector<BatchCase> cases = cases_in(text, columns);
    REQUIRE(cases.size() == 1);
    const std::string folder = fs::path(cases.front().input).parent_path().string() + "/";
    Names options = prepare_arguments(cases.front(), "cfd", "out");
    options.erase(options.begin(), options.begin() + 7);
    for (std::string& option : options)
        if (const auto place = option.find(folder); place != std::string::npos)
            option.erase(place, folder.size());
    return options;
}

Names case_names(const std::vector<BatchCase>& cases) {
    Names names;
    for (const BatchCase& one : cases) names.push_back(one.name);
    return names;
}

}  // namespace

SCENARIO("CSV is read as RFC 4180 defines it", "[workbench][batch]") {
    const auto fields = [](const std::string& text) { return csv_records(text).at(0).fields; };
    CHECK(fields("a,b,\r\n") == Names{"a", "b", ""});
    CHECK(fields("\"a,\"\"b\"\"\r\nc\",d") == Names{"a,\"b\"\r\nc", "d"});
    CHECK(fields("\xEF\xBB\xBFinput\n") == Names{"input"});
    CHECK(csv_records("").empty());
    THEN("records know their lines, also behind empty ones and line breaks in quotes") {
        const auto records = csv_records("a\n\n\"b\nb\"\r\nc");
        REQUIRE(records.size() == 3);
        CHECK(records[1].line == 3);
        CHECK(records[2].line == 5);
    }
    THEN("what is written in quotes is read back") {
        const std::string text = "\"=1,\r\n<b>\" \"";
        CHECK(fields(csv_quoted(text)) == Names{text});
    }
    THEN("what is not CSV is refused with its line") {
        CHECK_THROWS_WITH(csv_records("a\n\"b\n"), Contains("line 2: a quote is not closed"));
        CHECK_THROWS_WITH(csv_records("a\nb\"c\n"), Contains("line 2: a field with quotes"));
        CHECK_THROWS_WITH(csv_records("\"a\"b\n"), Contains("line 1: a field with quotes"));
        CHECK_THROWS_WITH(csv_records(std::string("\xFF\xFEi\0", 4)), Contains("UTF-8"));
    }
}

SCENARIO("A row of a manifest becomes the arguments of prepare", "[workbench][batch]") {
    CHECK(options_in("input,mask,units,inlet,accept-doubts,smooth.iterations\n"
                     "a.stl,m.nrrd,cm,1;-3,yes,30\n") ==
          Names{"--mask=m.nrrd", "--units=cm", "--inlet=1", "--inlet=-3", "--accept-doubts",
                "--set=smooth.iterations=30"});
    CHECK(options_in("input,mask,units,accept-doubts\na.stl,,,no\n").empty());
    CHECK(options_in("neighbour,input\n\"b.stl;7,8\",a.stl\n") ==
          Names{"--neighbour=b.stl", "--neighbour=7,8"});
    CHECK(options_in("input,openfoam.flow\na.stl,2\n") == Names{"--set=openfoam.flow=2"});
    GIVEN("values of all cases") {
        CaseColumns columns = kColumns;
        columns.shared = {{"units", "mm"}, {"set", "smooth.iterations=5"}};
        THEN("a row's own replace them; of settings, the last one counts") {
            CHECK(options_in("input,units,smooth.iterations\na.stl,cm,7\n", columns) ==
                  Names{"--set=smooth.iterations=5", "--units=cm", "--set=smooth.iterations=7"});
            CHECK(options_in("input,units\na.stl,\n", columns) ==
                  Names{"--units=mm", "--set=smooth.iterations=5"});
        }
    }
    THEN("a case has the name it is given, else that of its input") {
        CHECK(case_names(cases_in("case,input\nP1,x/scan.nii.gz\n,scan.nii.gz\n,my vein.stl\n")) ==
              Names{"P1", "scan", "my_vein"});
        CHECK(cases_in("input\naneurysm\n").front().input == "aneurysm");  // the bundled one
    }
}

SCENARIO("What a row says goes before what all cases are given", "[workbench][batch]") {
    CaseColumns columns = kColumns;
    columns.shared = {{.option = "accept-doubts", .text = {}, .is_flag = true},
                      {.option = "units", .text = "cm"},
                      {.option = "name", .text = {}}};
    CHECK(options_in("input,accept-doubts,units\na.stl,no,mm\n", columns) ==
          Names{"--name=", "--units=mm"});
    CHECK(options_in("input,accept-doubts,units\na.stl,,\n", columns) ==
          Names{"--accept-doubts", "--units=cm", "--name="});
}

SCENARIO("Other voxels beside the same header make another case", "[workbench][batch]") {
    const std::string folder = temporary_folder();
    const BatchOptions options{.folders = {folder + "/out"}, .purpose = "cfd", .limits = {}};
    const auto key_of = [&](const std::string& header) {
        return planned({.name = "a", .input = folder + "/" + header}, options, "program").key;
    };
    write_text(folder + "/a.mhd", "NDims = 3\nElementDataFile = a.raw\n");
    write_text(folder + "/a.nhdr", "NRRD0004\ndata file: a.raw\n");
    for (const char* header : {"a.mhd", "a.nhdr"}) {
        write_text(folder + "/a.raw", "1");
        const std::string key = key_of(header);
        CHECK(key_of(header) == key);
        write_text(folder + "/a.raw", "2");
        CHECK(key_of(header) != key);
    }
}

SCENARIO("A wrong manifest is refused with line and column", "[workbench][batch]") {
    const auto [text, words] = GENERATE(table<std::string, std::string>(
        {{"", "it is empty"},
         {"input\n", "it has no case"},
         {"mask\na.nrrd\n", "line 1: there is no column 'input'"},
         {"input,inlett\na.stl,1\n", "line 1: there is no column 'inlett'; did you mean 'inlet'"},
         {"input,smooth.iteration\na,1\n", "did you mean 'smooth.iterations'"},
         {"input,load-neighbour.file\na,b.stl\n", "there is no column 'load-neighbour.file'"},
         {"input,out\na.stl,b\n", "line 1: there is no column 'out'"},
         {"input;units\na.stl;mm\n", "fields are separated by commas"},
         {"input,units,units\na,mm,mm\n", "line 1: there are two columns 'units'"},
         {"input,units\n\na.stl\n", "line 3: 1 field where the first line has 2 columns"},
         {"input,units\n,mm\n", "line 2: it has no input"},
         {"input,accept-doubts\na.stl,maybe\n", "line 2: accept-doubts must be yes or no"},
         {"input\na.stl\nb/a.ply\n", "line 3: the case's name 'a' is that of line 2, too"},
         {"case,input\n../x,a.stl\n", "line 2: the case's name '../x' must be"},
         {"case,input\n..,a.stl\n", "line 2: the case's name '..' must be"},
         {"case,input\n<script>,a.stl\n", "line 2: the case's name '<script>' must be"}}));
    INFO(text);
    CHECK_THROWS_AS(cases_in(text), InvalidInput);
    CHECK_THROWS_WITH(cases_in(text), Contains("'cases.csv', ") && Contains(words));
}

SCENARIO("The readable files of a folder are its cases", "[workbench][batch]") {
    const std::string folder = temporary_folder();
    Names skipped;
    const auto cases = [&] {
        return case_names(cases_in_folder(
            folder, kColumns, [&](const std::string& name) { skipped.push_back(name); }));
    };
    CHECK_THROWS_WITH(cases(), Contains("has no surface, image or case"));
    for (const char* name : {"b.stl", "a.stl", "a.ply", "c.nii.gz", "notes.txt", ".hidden.stl"})
        write_text(folder + "/" + name, "");
    fs::create_directories(folder + "/phantom");
    write_text(folder + "/phantom/case.json", "{}");
    fs::create_directories(folder + "/figures");
    CHECK(cases() == Names{"a.ply", "a.stl", "b", "c", "phantom"});
    CHECK(skipped == Names{"figures", "notes.txt"});
}

SCENARIO("A recipe of a row is a bundled one or a file beside the manifest", "[workbench][batch]") {
    CaseColumns columns = kColumns;
    columns.options.push_back({.name = "recipe", .is_file = true});
    const auto recipe = [&](const std::string& name) {
        const std::vector<BatchCase> cases =
            cases_in("input,recipe\na.stl," + name + "\n", columns);
        REQUIRE(cases.size() == 1);
        const std::string argument = prepare_arguments(cases.front(), "cfd", "out").back();
        REQUIRE(argument.starts_with("--recipe="));
        return argument.substr(argument.find('=') + 1);
    };
    CHECK(recipe("tree-cfd") == "tree-cfd");
    CHECK(fs::path(recipe("mine.json")).is_absolute());
    CHECK(fs::path(recipe("./tree-cfd")).is_absolute());  // a file that is called like one
}
