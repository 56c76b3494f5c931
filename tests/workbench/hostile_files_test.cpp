#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

std::string written(const std::string& name, const std::string& bytes) {
    const std::string file = temporary_folder() + "/" + name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

template <class Error>
std::string error_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "no such error";
}

std::string refusal(const std::string& file) {
    return error_of<InvalidInput>([&] { (void)read_surface(file); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// A compressed array of `blocks` blocks in 32-bit words, as VTK appends it.
std::string compressed_array(std::uint32_t blocks, std::uint32_t size, std::uint32_t last,
                             std::uint32_t stored) {
    std::string bytes;
    for (const std::uint32_t word : {blocks, size, last, stored})
        bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
    return bytes + std::string(40, 'x');
}

std::string vtp_with(const std::string& points, const std::string& appended,
                     const std::string& offset = "0") {
    return "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" "
           "compressor=\"vtkZLibDataCompressor\">\n<PolyData><Piece NumberOfPoints=\"" +
           points +
           "\" NumberOfPolys=\"0\"><Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" "
           "format=\"appended\" offset=\"" +
           offset + "\"/></Points></Piece></PolyData>\n" + appended + "</VTKFile>\n";
}

/// A triangle in VTK XML. \param inside in front of its piece \param end behind the poly data
std::string triangle_vtp(const std::string& inside, const std::string& end = "") {
    return "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>" +
           inside +
           "<Piece NumberOfPoints='3' NumberOfPolys='1'><Points><DataArray type='Float32' "
           "NumberOfComponents='3' format='ascii'>0 0 0 1 0 0 0 1 0</DataArray></Points>\n<Polys>"
           "<DataArray type='Int64' Name='connectivity' format='ascii'>0 1 2</DataArray>"
           "<DataArray type='Int64' Name='offsets' format='ascii'>3</DataArray></Polys></Piece>"
           "</PolyData>\n" +
           end + "</VTKFile>\n";
}

/// ASCII text as UTF-16, the low byte first.
std::string wide(const std::string& text) {
    std::string bytes = "\xff\xfe";
    for (const char c : text) bytes += {c, '\0'};
    return bytes;
}

std::string appended(const std::string& bytes) {
    return "<AppendedData encoding=\"raw\">\n_" + bytes + "</AppendedData>";
}

}  // namespace

SCENARIO("PLY elements without properties are refused at once", "[workbench][hostile]") {
    const std::string head = "ply\nformat ascii 1.0\n";
    CHECK_THAT(refusal(written("a.ply", head + "element x 999999999999999999\nend_header\n")),
               Contains("'x' elements have no properties"));
    CHECK_THAT(refusal(written("b.ply", head + "element face 999999999999\nend_header\n")),
               Contains("no properties"));
}

SCENARIO("Legacy VTK files announce no more than they hold", "[workbench][hostile]") {
    const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n";
    CHECK_THAT(refusal(written("a.vtk", head + "POINTS 60 double\n0 0 0\n")),
               Contains("truncated"));
    CHECK_THAT(refusal(written("b.vtk", head + "POINTS 1 double\n0 0 0\nFIELD f 1\nx 90 90 int\n")),
               Contains("truncated"));
}

SCENARIO("VTP files with impossible data never reach VTK", "[workbench][hostile]") {
    const auto check = [](const std::string& text, const std::string& why) {
        CHECK_THAT(refusal(written("a.vtp", text)), Contains(why) && Contains("damaged"));
    };
    check(vtp_with("4", ""), "appended data is missing");
    check(vtp_with("4", appended("")), "appended data is missing");
    check(vtp_with("4", appended(compressed_array(1, 48, 48, 40)), "9999"),
          "appended data is missing");
    check(vtp_with("4", appended(compressed_array(1, 0, 0, 40))), "impossible size");
    check(vtp_with("4", appended(compressed_array(1, 0x7fffffff, 48, 40))), "impossible size");
    check(vtp_with("4", appended(compressed_array(0x7fffffff, 48, 48, 40))), "data is missing");
    check(vtp_with("4", appended(compressed_array(1, 48, 48, 4000))), "data is missing");
    check(vtp_with("4", appended(compressed_array(0, 48, 48, 40))), "without blocks has a rest");
    check(vtp_with("0", appended(std::string(4, '\0'))), "without blocks has a rest");
    check(vtp_with("999999999999", appended(compressed_array(1, 48, 48, 40))), "NumberOfPoints");
    check(vtp_with("-1", appended(compressed_array(1, 48, 48, 40))), "NumberOfPoints");
    THEN("good ones do") {
        const std::string file = temporary_folder() + "/tube.vtp";
        write_surface(closed_tube(2.0, 8.0, 12, 4), file);
        CHECK(read_surface(file).surface.patches.size() == 3);
    }
}

SCENARIO("No list of a VTK XML file hides from the checks", "[workbench][hostile]") {
    const auto check = [](const std::string& text, const std::string& why) {
        INFO(text.substr(0, 200));
        const std::string error = refusal(written("a.vtp", text));
        CHECK_THAT(error, Contains(why) && Contains("a.vtp") && !Contains("\n"));
    };
    const auto list = [](const std::string& attributes, const std::string& bytes) {
        return "<FieldData><Array Name='n' NumberOfTuples='1' " + attributes + ">" + bytes +
               "</Array></FieldData>";
    };
    const std::string texts = list("type='String' format='ascii'", "97 0 98 0");
    check(triangle_vtp(texts), "texts is longer");
    const std::string entity = "<?xml version='1.0'?>\n<!DOCTYPE VTKFile [<!ENTITY e \"";
    check(entity + texts + "\">]>\n" + triangle_vtp("&e;"), "<!DOCTYPE");
    check(wide(triangle_vtp(texts)), "UTF-16");
    check(wide(triangle_vtp(texts)).substr(2), "UTF-16");
    check(std::string("\0\0\xfe\xff", 4) + triangle_vtp(texts), "UTF-16");
    // VTK would go on reading 4096 bytes further on.
    check("<!-- <AppendedData>" + std::string(4096, ' ') + "-->" + triangle_vtp(texts), "XML");
    check(triangle_vtp(list("type='String' format='ascii'", "97 256 98 256")), "texts is longer");
    check(triangle_vtp(list("type='String' format='ascii'", "97 0+0+0+0")), "a byte should be");
    check(triangle_vtp("<FieldData><DataArray type='String' Name='n' NumberOfTuples='1' "
                       "format='ascii'>0 0</DataArray></FieldData>"),
          "texts is longer");
    check(triangle_vtp("<FieldData><DataArray type='Int8' NumberOfTuples='9' format='ascii' "
                       "offset='4'>0 0</DataArray></FieldData>"),
          "appended data is missing");
    check(triangle_vtp("<FieldData><DataArray type='Int8' NumberOfComponents\n= '999999999' "
                       "format='ascii'>0 0</DataArray></FieldData>"),
          "announces an array");
    std::string deep;
    for (int i = 0; i < 100; ++i) deep = "<a>" + deep + "</a>";
    check(triangle_vtp(deep), "XML");
    THEN("appended data may hold any bytes") {
        const std::string bytes = "<!DOCTYPE <!ENTITY <AppendedData \xff\xfe";
        const auto size = static_cast<char>(bytes.size());
        const std::string file =
            written("good.vtp",
                    triangle_vtp("<FieldData><DataArray type='UInt8' Name='n' NumberOfTuples='" +
                                     std::to_string(bytes.size()) +
                                     "' format='appended' offset='0'/></FieldData>",
                                 appended(std::string({size, '\0', '\0', '\0'}) + bytes)));
        CHECK(read_surface(file, LengthUnit::Millimetre).surface.triangle_count() == 1);
    }
    THEN("images are checked as well") {
        const std::string vti = written(
            "a.vti", entity + texts +
                         "\">]><VTKFile type='ImageData'><ImageData WholeExtent='0 1 0 1 0 1'>"
                         "&e;</ImageData></VTKFile>");
        CHECK_THAT(error_of<InvalidInput>([&] { (void)read_image(vti); }), Contains("<!DOCTYPE"));
    }
}

SCENARIO("VTK's own words about a file are not shown", "[workbench][hostile]") {
    const std::string folder = temporary_folder(), file = folder + "/tube.vtp";
    write_surface(closed_tube(2.0, 8.0, 12, 4), file);
    write_text(file, replaced(file_content(file), "<Points>", "<Points"));
    const ProgramRun run = run_program(program_path(), {"measure", file});
    CHECK(run.exit_code == 3);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK_THAT(run.err, Contains("vesselbench: ") && Contains("tube.vtp"));
}

SCENARIO("Compressed images announce no more than they can hold", "[workbench][hostile]") {
    const std::string file = written(
        "a.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1000 1000 900\nencoding: gzip\n\n" +
                      std::string(300, '\x1f'));
    CHECK_THAT(error_of<InvalidInput>([&] { (void)read_image(file); }),
               Contains("900000000 bytes") && Contains("compressed"));
    const std::string vti = written(
        "a.vti",
        "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 999 0 999 0 899\"></VTKFile>");
    CHECK_THROWS_AS(read_image(vti), InvalidInput);
}

SCENARIO("Devices, pipes and sockets are no input", "[workbench][hostile]") {
    const std::string folder = temporary_folder();
    for (const std::string name : {"a.stl", "a.vtk", "a.nrrd", "a.dcm", "a"}) {
        INFO(name);
        const std::string pipe = folder + "/" + name;
        REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"new", folder + "/p.vbench", pipe},
              {"measure", pipe},
              {"prepare", pipe, "--for", "rp", "--out", folder + "/out"}}) {
            const ProgramRun run = run_program("/usr/bin/timeout", [&] {
                std::vector<std::string> words = {"20", program_path()};
                words.insert(words.end(), arguments.begin(), arguments.end());
                return words;
            }());
            INFO(arguments[0] << ": " << run.err);
            CHECK(run.exit_code == 3);
        }
    }
    CHECK_THROWS_AS(file_content("/dev/zero"), IoError);
    CHECK_FALSE(std::filesystem::exists(folder + "/p.vbench"));
}

SCENARIO("A link that leads to itself is refused in our words", "[workbench][hostile]") {
    const std::string folder = temporary_folder();
    write_surface(cube(10.0), folder + "/cube.stl");
    for (const char* name : {"loop.stl", "loop.nrrd", "loop.vtk", "loop"})
        std::filesystem::create_symlink(name, folder + "/" + name);
    std::filesystem::create_directories(folder + "/case");
    std::filesystem::create_symlink("case.json", folder + "/case/case.json");
    std::filesystem::create_directories(folder + "/slices");
    std::filesystem::create_symlink("1.dcm", folder + "/slices/1.dcm");
    const auto check = [](const std::vector<std::string>& arguments, const std::string& why) {
        const ProgramRun run = run_program(program_path(), arguments);
        INFO(arguments[0] << " " << arguments.back() << ": " << run.err);
        CHECK(run.exit_code == 3);
        CHECK_THAT(run.err, Contains(why) && !Contains("filesystem"));
        CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    };
    const std::string loop = "a link that leads to itself", project = folder + "/p.vbench";
    const auto prepare = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"prepare", "--for", "rp", "--out", folder + "/out"};
        words.insert(words.end(), more.begin(), more.end());
        check(words, loop);
    };
    for (const char* name : {"/loop.stl", "/loop.nrrd", "/loop.vtk", "/loop", "/case"}) {
        check({"new", project, folder + name}, loop);
        prepare({folder + name});
    }
    check({"measure", folder + "/loop.stl"}, loop);
    check({"measure", folder + "/cube.stl", folder + "/loop.stl"}, loop);
    CHECK(run_program(program_path(), {"new", project, folder + "/slices"}).exit_code == 3);
    check({"log", folder + "/loop"}, loop);
    prepare({folder + "/cube.stl", "--recipe", folder + "/loop"});
    prepare({folder + "/cube.stl", "--neighbour", folder + "/loop.stl"});
    prepare({folder + "/cube.stl", "--mask", folder + "/loop.nrrd"});
    check({"prepare", folder + "/cube.stl", "--for", "rp", "--out", folder + "/loop"}, "loop");
    CHECK_FALSE(std::filesystem::exists(project));
}

SCENARIO("What notes and names contain is shown escaped", "[workbench][hostile]") {
    const std::string folder = temporary_folder(), project = folder + "/p.vbench";
    write_surface(cube(10.0), folder + "/cube.stl");
    const auto run = [](const std::vector<std::string>& arguments) {
        return run_program(program_path(), arguments);
    };
    REQUIRE(run({"new", project, folder + "/cube.stl"}).exit_code == 0);
    const std::string note = "red \x1b[31m and \x07 title \x1b]0;x\x07";
    const ProgramRun noted = run({"note", project, "1", note});
    CHECK(noted.exit_code == 0);
    CHECK_THAT(noted.out, Contains("\\x1b[31m") && !Contains("\x1b"));
    CHECK_THAT(run({"log", project}).out, Contains("\\x1b]0;x\\x07") && !Contains("\x1b"));
    REQUIRE(run({"apply", project, "repair", "--author", "red \x1b[32m"}).exit_code == 0);
    for (const char* form : {"", "--json"}) {
        std::vector<std::string> log = {"log", project};
        if (*form != '\0') log.emplace_back(form);
        CHECK_THAT(run(log).out, Contains("1b[32m") && !Contains("\x1b"));
    }
    CHECK_THAT(run({"measure", folder + "/\x1b[31m.stl"}).err, !Contains("\x1b"));
}

SCENARIO("What a model lacks for an operation gives exit code 1", "[workbench][hostile]") {
    const std::string folder = temporary_folder(), project = folder + "/p.vbench";
    write_surface(cube(10.0), folder + "/cube.stl");
    const auto code = [](const std::vector<std::string>& arguments) {
        const ProgramRun run = run_program(program_path(), arguments);
        INFO(run.err);
        return run.exit_code;
    };
    REQUIRE(code({"new", project, folder + "/cube.stl"}) == 0);
    CHECK(code({"apply", project, "extract-surface"}) == 1);                       // no image
    CHECK(code({"apply", project, "extrude-opening"}) == 1);                       // no openings
    CHECK(code({"apply", project, "smooth", "distance=linear"}) == 1);             // no neighbour
    CHECK(code({"apply", project, "smooth", "painted=weight"}) == 1);              // no attribute
    CHECK(code({"apply", project, "load-neighbour", "name=a", "labels=1"}) == 1);  // no mask
    CHECK(code({"export", project, folder + "/a.msh"}) == 1);                      // no volume mesh
    CHECK(code({"export", project, folder + "/case/"}) == 1);
}

SCENARIO("A signal to the whole group stops the program, with no word of damage",
         "[workbench][hostile]") {
    const std::string folder = temporary_folder();
    write_text(folder + "/run.sh",
               "setsid \"$1\" prepare \"$2\" --for cfd --out \"$3\" &\npid=$!\n"
               "for i in $(seq 200); do [ -f \"$3/project.vbench\" ] && break; sleep 0.05; done\n"
               "kill -TERM -- -$pid\nwait $pid\n");
    write_surface(closed_tube(3.0, 40.0, 48, 200), folder + "/tube.vtp");
    const ProgramRun run = run_program(
        "/bin/bash", {folder + "/run.sh", program_path(), folder + "/tube.vtp", folder + "/out"});
    INFO(run.err);
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains("stopped") && !Contains("damaged"));
}
