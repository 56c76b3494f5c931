#include "workbench/prepare/prepare.h"

#include <algorithm>
#include <iostream>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console.h"
#include "workbench/export/products.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

void check_purpose(const std::string& purpose) {
    static const std::vector<std::string> purposes = {"cfd", "rp", "planning", "simulation"};
    if (std::ranges::count(purposes, purpose) == 0)
        throw UsageError("--for '" + purpose + "' is not known" + did_you_mean(purpose, purposes) +
                         " (it is " + joined(purposes) + ")");
}

InputOptions input_options(const InputArguments& arguments) {
    return {arguments.input, arguments.mask, arguments.units};
}

}  // namespace

void prepare_case(const PrepareArguments& arguments, const Progress& progress) {
    check_purpose(arguments.purpose);
    prepare({.input = input_options(arguments.input),
             .purpose = arguments.purpose,
             .recipe = arguments.recipe,
             .arguments = arguments.settings,
             .out = arguments.out},
            remark, progress);
    const std::filesystem::path out = arguments.out;
    const auto [what, file] = arguments.purpose == "cfd" ? std::pair("CFD case:    ", "openfoam")
                              : arguments.purpose == "rp"
                                  ? std::pair("print model: ", "print.stl")
                                  : std::pair("surface:     ", "surface.vtp");
    std::cout << what << (out / file).string()
              << "\nreport:      " << (out / "report.html").string()
              << "\nproject:     " << (out / "project.vbench").string() << "\n";
}

void make_project(const std::string& project, const InputArguments& arguments,
                  const Progress& progress) {
    new_project(project, input_options(arguments), remark, progress);
    std::cout << "made " << project << "\n";
}

void export_project(const ExportArguments& arguments, const Progress& progress) {
    std::vector<std::string> settings = arguments.settings;
    const CfdParameters flow = take_flow_parameters(settings);
    if (!settings.empty())
        throw UsageError("--set '" + settings.front() +
                         "': export knows openfoam.parameter=value only");
    check_export_name(arguments.file);
    Session session = Session::open(arguments.project, {.find = find_operation});
    const Scene scene = session.scene(arguments.variant, progress.part(0.0, 0.7));
    PendingFiles files;
    export_scene(files, arguments.file, scene, flow);
    progress.check_cancelled();
    files.commit();
    std::cout << "wrote " << arguments.file << "\n";
}

}  // namespace vesselbench
