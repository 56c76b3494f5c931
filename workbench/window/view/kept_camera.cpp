#include "workbench/window/view/kept_camera.h"

#include <cmath>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/case/json_text.h"
#include "workbench/case/point_json.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kLeastAngle = 1e-6;  ///< sine between view and up

/// \throw InvalidInput for one that shows nothing
void check_camera(const ViewCamera& camera) {
    const bool finite = camera.centre.allFinite() && camera.view.allFinite() &&
                        camera.up.allFinite() && std::isfinite(camera.half_height);
    const double span = camera.view.norm() * camera.up.norm();
    if (!finite || camera.half_height <= 0.0 ||
        !(camera.view.cross(camera.up).norm() > kLeastAngle * span))
        throw InvalidInput("the stored view shows nothing");
}

void store_camera(const std::filesystem::path& project, const std::vector<ViewCamera>& cameras) {
    const ViewCamera& camera = cameras.back();
    store_view(project, text_from_json(Json({{"centre", point_json(camera.centre)},
                                             {"view", point_json(camera.view)},
                                             {"up", point_json(camera.up)},
                                             {"half_height", camera.half_height},
                                             {"perspective", camera.perspective}})));
}

std::vector<ViewCamera> stored_camera(const std::filesystem::path& project) {
    const std::string text = stored_view(project);
    if (text.empty()) return {};
    const Json json = json_from_text(text, "the stored view");
    try {
        ViewCamera camera{.centre = point_from(json.at("centre")),
                          .view = point_from(json.at("view")),
                          .up = point_from(json.at("up")),
                          .half_height = json.at("half_height").get<double>(),
                          .perspective = json.at("perspective").get<bool>()};
        check_camera(camera);
        return {camera};
    } catch (const nlohmann::json::exception&) {
        throw InvalidInput("the stored view is damaged");
    }
}

}  // namespace

KeptCamera::KeptCamera(std::function<void()> wake)
    : list_(std::move(wake), {.what = "view", .read = stored_camera, .store = store_camera}) {}

void KeptCamera::open(const std::filesystem::path& project, const std::string& read_only) {
    list_.open(project, read_only);
}

void KeptCamera::close(const std::optional<ViewCamera>& last) {
    if (last && camera() != last && list_.is_read())
        list_.change([&](std::vector<ViewCamera>& cameras) { cameras = {*last}; });
    // A view that is lost is no news.
    static_cast<void>(list_.close());
}

std::optional<ViewCamera> KeptCamera::camera() const {
    return list_.all().empty() ? std::nullopt : std::optional(list_.all().back());
}

}  // namespace vesselbench
