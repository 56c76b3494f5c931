#include "tests/fuzz/targets.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <new>
#include <vector>

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/formats/centerline_file.h"
#include "geometry/formats/dicom.h"
#include "geometry/formats/image_file.h"
#include "geometry/formats/legacy_vtk.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/phantoms/phantom.h"
#include "tests/fuzz/project_specimens.h"
#include "tests/support/paths.h"
#include "workbench/case/json_text.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/prepare/input.h"
#include "workbench/prepare/recipe.h"
#include "workbench/prepare/recipe_document.h"
#include "workbench/project/serialization.h"
#include "workbench/project/stored_text.h"

namespace vesselbench::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr int kSeconds = 10;  // of CPU time

[[noreturn]] void wrong(const std::string& what) {
    throw std::logic_error(what);
}

void check(const Surface& surface) {
    for (const Triangle& triangle : surface.topology->triangles())
        for (const VertexId v : triangle)
            if (v >= surface.points().size()) wrong("a triangle without its vertices was accepted");
    for (const Vec3& p : surface.points())
        if (!p.allFinite()) wrong("a point that is not finite was accepted");
    for (const auto& [name, values] : surface.attributes)
        if (values->size() != surface.vertex_count()) wrong("an attribute of a wrong length");
}

void check(const Image& image) {
    if (!image.voxels || image.voxels->size() != image.voxel_count())
        wrong("an image of a wrong size was accepted");
    if (!image.index_to_patient.allFinite()) wrong("an image without a finite place was accepted");
    for (const float value : *image.voxels)
        if (!std::isfinite(value)) wrong("a voxel that is not finite was accepted");
}

void read_as_surface(const fs::path& file) {
    check(read_surface(file.string()).surface);
}

void read_as_image(const fs::path& file) {
    check(read_image(file.string()));
}

void read_as_either(const fs::path& file) {
    holds_surface(file.string()) ? read_as_surface(file) : read_as_image(file);
}

void read_as_recipe(const fs::path& file) {
    const auto json = find_recipe(file.string()).entries;
    for (const RecipeUse& use : {RecipeUse{"surface", "cfd"}, RecipeUse{"image", "mask", "rp"}})
        (void)recipe_from_json(json, use);
}

void read_as_case(const fs::path& file) {
    fs::rename(file, file.parent_path() / "case.json");
    std::stop_source stop;
    const Progress until_made([&](double, std::string_view) { stop.request_stop(); },
                              stop.get_token());
    const Input input = resolve_input({.input = file.parent_path().string()}, until_made);
    (void)own_recipe(input, "cfd");
}

void read_as_phantom(const fs::path& file) {
    const PhantomDescription phantom = phantom_from_json(file_content(file));
    std::stop_source stop;
    stop.request_stop();
    (void)make_phantom(phantom, Progress({}, stop.get_token()));
}

std::span<const std::byte> as_bytes(const std::string& text) {
    return std::as_bytes(std::span(text));
}

void read_as_scene(const fs::path& file) {
    const std::string bytes = file_content(file);
    const Scene scene = decode_scene(as_bytes(bytes));
    if (scene.surface) check(*scene.surface);
}

void read_as_part(const fs::path& file) {
    const std::string bytes = file_content(file);
    PartDecoder decoder(as_bytes(bytes));
    (void)decoder.finish();
}

void read_as_arguments(const fs::path& file) {
    const std::string bytes = file_content(file);
    if (bytes.starts_with('{'))
        (void)arguments_from_stored(bytes);
    else
        (void)arguments_from_stored(unpack_text(as_bytes(bytes)));
}

/// Words of libraries, and bytes that a terminal obeys, have no place in an error's text.
std::string foreign_words(const std::string& text) {
    static constexpr std::array kForeign = {"json.exception", "std::",  "basic_string",
                                            "vector::",       "_M_",    "terminate",
                                            "vtkXML",         "gdcm::", "Sanitizer"};
    for (const char* word : kForeign)
        if (text.find(word) != std::string::npos &&
            text.find(std::string("'") + word) == std::string::npos)
            return word;
    if (text == "stod" || text == "stoi" || text == "stoul" || text == "stoll") return text;
    return {};
}

Reading refused(const std::exception& error) {
    const std::string text = error.what();
    const std::string foreign = foreign_words(text);
    if (!foreign.empty()) return {Verdict::Finding, "library text: " + text};
    return {text.empty() ? Verdict::Finding : Verdict::Refused, text};
}

/// The program's standard error and its end.
struct ProgramEnd {
    int status = 0;
    double seconds = 0.0;  ///< CPU time, with its workers'
    long kilobytes = 0;    ///< largest resident memory of one process
    std::string err;
};

ProgramEnd run(const std::vector<std::string>& words, const fs::path& folder) {
    const fs::path err = folder / "stderr.txt";
    const pid_t child = fork();
    if (child == 0) {
        const rlimit seconds{3 * kSeconds, 3 * kSeconds};
        setrlimit(RLIMIT_CPU, &seconds);
        if (std::freopen("/dev/null", "w", stdout) == nullptr ||
            std::freopen(err.c_str(), "w", stderr) == nullptr)
            _exit(126);
        std::vector<char*> pointers;
        for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
        pointers.push_back(nullptr);
        execv(pointers[0], pointers.data());
        _exit(127);
    }
    ProgramEnd end;
    rusage used{};
    wait4(child, &end.status, 0, &used);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    end.seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
    end.kilobytes = used.ru_maxrss;
    end.err = file_content(err);
    return end;
}

bool names_a_worker_that_died(const std::string& text) {
    return text.find("crashed (") != std::string::npos ||
           text.find("ended early (") != std::string::npos ||
           text.find(" failed (") != std::string::npos;
}

Reading judge(const ProgramEnd& end, std::uintmax_t size) {
    if (WIFSIGNALED(end.status))
        return {Verdict::Finding, "the program ended by signal " +
                                      std::to_string(WTERMSIG(end.status)) + "\n" + end.err};
    const int code = WEXITSTATUS(end.status);
    if (end.seconds > kSeconds) return {Verdict::Finding, "hang: over 10 s of CPU time"};
    if (code < 0 || code > 3)
        return {Verdict::Finding, "exit code " + std::to_string(code) + "\n" + end.err};
    if (end.err.find("Sanitizer") == std::string::npos && names_a_worker_that_died(end.err))
        return {Verdict::Contained, end.err};
    if (end.err.find("Sanitizer") != std::string::npos ||
        end.err.find("runtime error") != std::string::npos)
        return {Verdict::Contained, end.err};
    const std::string foreign = foreign_words(end.err);
    if (!foreign.empty()) return {Verdict::Finding, "library text: " + end.err};
    if (code != 0 && std::count(end.err.begin(), end.err.end(), '\n') != 1)
        return {Verdict::Finding, "not one line of error text: " + end.err};
#if !defined(__SANITIZE_ADDRESS__)
    constexpr std::uintmax_t kProgram = 300;  // [MiB] of the program itself, and the 256 allowed
    if (static_cast<std::uintmax_t>(end.kilobytes) > (kProgram + 256) * 1024 + 16 * size / 1024)
        return {Verdict::Finding, "memory: " + std::to_string(end.kilobytes / 1024) + " MiB for " +
                                      std::to_string(size) + " bytes"};
#else
    (void)size;
#endif
    if (end.err.find("more memory than its limit") != std::string::npos)
        return {Verdict::OverLimit, end.err};
    return {code == 0 ? Verdict::Accepted : Verdict::Refused, end.err};
}

}  // namespace

const std::map<std::string, Target>& targets() {
    static const std::map<std::string, Target> all = {
        {"stl", {.read = read_as_surface}},
        {"ply", {.read = read_as_surface}},
        {"obj", {.read = read_as_surface}},
        {"off", {.read = read_as_surface}},
        {"vtp", {.read = read_as_surface, .by_library = true}},
        {"vtk", {.read = read_as_either}},
        {"centerlines",
         {.read = [](const fs::path& file) { (void)read_centerlines(file.string()); },
          .by_library = true,
          .program = false}},
        {"nii", {.read = read_as_image}},
        {"nii.gz", {.read = read_as_image}},
        {"nrrd", {.read = read_as_image}},
        {"nhdr", {.read = read_as_image}},
        {"mha", {.read = read_as_image}},
        {"mhd", {.read = read_as_image}},
        {"vti", {.read = read_as_image, .by_library = true}},
        {"dcm", {.read = read_as_image, .by_library = true}},
        {"dicom-folder",
         {.read = [](const fs::path& file) { read_as_image(file.parent_path()); },
          .folder = true,
          .by_library = true}},
        {"case", {.read = read_as_case, .has_limit = false, .program = false}},
        {"recipe", {.read = read_as_recipe, .program = false}},
        {"phantom", {.read = read_as_phantom, .has_limit = false, .program = false}},
        {"scene", {.read = read_as_scene, .program = false}},
        {"part", {.read = read_as_part, .program = false}},
        {"arguments", {.read = read_as_arguments, .program = false}},
        {"project", {}},
    };
    return all;
}

Reading read_here(const Target& target, const fs::path& file) {
    try {
        target.read(file);
        return {};
    } catch (const UsageError& error) {
        return refused(error);
    } catch (const InvalidInput& error) {
        return refused(error);
    } catch (const IoError& error) {
        return refused(error);
    } catch (const AlgorithmFailure& error) {
        return refused(error);
    } catch (const Cancelled&) {
        return {};
    } catch (const std::bad_alloc&) {
        return {Verdict::OverLimit, ""};
    } catch (const std::exception& error) {
        return {target.by_library ? Verdict::Contained : Verdict::Finding,
                std::string("foreign exception: ") + error.what()};
    }
}

Reading read_by_program(const std::string& format, const fs::path& file) {
    const fs::path folder = file.parent_path() / "..";
    const std::string program = test::program_path(), project = (folder / "p.vbench").string();
    for (const char* rest : {"", "-lock", "-wal", "-shm"}) fs::remove(project + rest);
    std::uintmax_t size = 0;
    for (const auto& entry : fs::directory_iterator(file.parent_path()))
        if (entry.is_regular_file()) size += entry.file_size();
    if (format == "project") {
        Reading worst;
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{program, "log", file.string()},
              {program, "replay", file.string()},
              {program, "export", file.string(), (folder / "out.stl").string()}}) {
            const Reading reading = judge(run(words, folder), 4 * size);
            if (reading.verdict > worst.verdict) worst = reading;
        }
        return worst;
    }
    const bool takes_folder = targets().at(format).folder;
    return judge(run({program, "new", project, takes_folder ? file.parent_path() : file}, folder),
                 std::max<std::uintmax_t>(size, 1) * 129);
}

Reading read_project(const fs::path& damaged, const std::string& good_content, bool by_rows) {
    Reading reading;
    const Target target = {.read = [&](const fs::path& file) {
        const std::string content = content_of(file);
        if (!by_rows && !content.empty() && content != good_content)
            wrong("a damaged project was accepted silently");
    }};
    reading = read_here(target, damaged);
    if (reading.verdict == Verdict::Refused && names_a_worker_that_died(reading.text))
        reading.verdict = Verdict::Finding;
    return reading;
}

}  // namespace vesselbench::fuzz
