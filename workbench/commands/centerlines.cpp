#include "geometry/vessel/centerlines/centerlines.h"

#include <algorithm>
#include <iostream>
#include <numeric>

#include <nlohmann/json.hpp>

#include "geometry/formats/centerline_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/vessel_check.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/operations/shared/foreign_surface.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

double length_of(const CenterlineBranch& branch) {
    double length = 0.0;
    for (std::size_t i = 1; i < branch.points.size(); ++i)
        length += (branch.points[i] - branch.points[i - 1]).norm();
    return length;
}

Json node_json(const CenterlineNode& node) {
    return {{"position", {node.position.x(), node.position.y(), node.position.z()}},
            {"radius", node.radius},
            {"tip", node.is_tip()},
            {"branches", node.branches}};
}

Json branch_json(const CenterlineBranch& branch) {
    const auto [least, largest] = std::ranges::minmax(branch.radii);
    const double mean = std::reduce(branch.radii.begin(), branch.radii.end()) /
                        static_cast<double>(branch.radii.size());
    return {{"start_node", branch.start_node},
            {"end_node", branch.end_node},
            {"points", branch.points.size()},
            {"length", length_of(branch)},
            {"radius", {{"min", least}, {"mean", mean}, {"max", largest}}}};
}

Json graph_json(const CenterlineGraph& graph) {
    Json json = {{"nodes", Json::array()}, {"branches", Json::array()}};
    for (const CenterlineNode& node : graph.nodes) json["nodes"].push_back(node_json(node));
    for (const CenterlineBranch& branch : graph.branches)
        json["branches"].push_back(branch_json(branch));
    return json;
}

std::string short_number(const Json& number) {
    return formatted(number.get<double>(), "%.4g");
}

std::string node_name(const CenterlineGraph& graph, std::size_t node) {
    return std::to_string(node) + (graph.nodes[node].is_tip() ? " (end)" : "");
}

void print_table(const CenterlineGraph& graph) {
    std::vector<std::vector<std::string>> rows = {
        {"branch", "from node", "to node", "length [mm]", "radius min / mean / max [mm]"}};
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        const Json json = branch_json(graph.branches[b]);
        const Json& radius = json["radius"];
        rows.push_back({std::to_string(b), node_name(graph, graph.branches[b].start_node),
                        node_name(graph, graph.branches[b].end_node), short_number(json["length"]),
                        short_number(radius["min"]) + " / " + short_number(radius["mean"]) + " / " +
                            short_number(radius["max"])});
    }
    std::cout << as_columns(rows);
}

}  // namespace

void find_centerlines(const CenterlineOptions& options, const Progress& progress) {
    check_centerline_name(options.out);
    const Surface surface = read_foreign_surface(options.surface, options.units);
    require_lumen(surface, SurfaceOrigin::File);
    const CenterlineGraph graph = compute_centerlines(surface, {}, progress);
    write_centerlines(graph, options.out);
    if (options.json) {
        Json document = graph_json(graph);
        document["file_units"] = assumed_units(options.units);
        std::cout << text_from_json(document, 2) << "\n";
        return;
    }
    print_table(graph);
    std::cout << "Lengths in mm; the file was read in " << assumed_units(options.units)
              << (options.units.empty() ? " (--units cm or m reads it otherwise)" : "") << ".\n";
}

}  // namespace vesselbench
