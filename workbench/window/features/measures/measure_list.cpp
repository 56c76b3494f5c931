#include "workbench/window/features/measures/measure_list.h"

#include <algorithm>
#include <utility>

#include "workbench/session/edit_run.h"

namespace vesselbench {

namespace {

/// The first "Distance 1", "Distance 2" ... that is free.
std::string free_name(const std::vector<KeptMeasure>& measures, MeasureKind kind) {
    const std::string base = kind == MeasureKind::Distance ? "Distance " : "Diameter ";
    for (std::size_t number = 1;; ++number) {
        std::string name = base + std::to_string(number);
        if (std::ranges::find(measures, name, &KeptMeasure::name) == measures.end()) return name;
    }
}

}  // namespace

MeasureList::MeasureList(std::function<void()> wake)
    : list_(std::move(wake),
            {.what = "measures", .read = stored_measures, .store = store_measures}) {}

void MeasureList::open(const std::filesystem::path& project, std::string read_only) {
    begin_next();
    made_ = 0;
    list_.open(project, std::move(read_only));
}

std::string MeasureList::close() {
    begin_next();
    made_ = 0;
    return list_.close();
}

void MeasureList::begin_next() {
    first_.reset();
    lengthens_ = false;
}

void MeasureList::click(const Vec3& point, const MeasuredModel& model) {
    if (model != model_) begin_next();
    model_ = model;
    if (lengthens_) return lengthen(point);
    if (!first_) {
        first_ = point;
        return;
    }
    const std::vector<Vec3> points = {*std::exchange(first_, std::nullopt), point};
    keep({.kind = MeasureKind::Distance, .points = points, .length = path_length(points)}, model);
    lengthens_ = true;
}

void MeasureList::lengthen(const Vec3& point) {
    list_.change([&](std::vector<KeptMeasure>& measures) {
        KeptMeasure& newest = measures.back();
        newest.points.push_back(point);
        newest.length = path_length(newest.points);
    });
}

void MeasureList::add(const VesselDiameter& diameter, const MeasuredModel& model) {
    begin_next();
    std::vector<Vec3> points = {diameter.centre};
    points.insert(points.end(), diameter.outline.begin(), diameter.outline.end());
    keep({.kind = MeasureKind::Diameter,
          .points = std::move(points),
          .length = diameter.inscribed,
          .area = diameter.area,
          .equivalent = diameter.equivalent},
         model);
}

void MeasureList::keep(KeptMeasure measure, const MeasuredModel& model) {
    measure.on = model.on;
    measure.state = model.state;
    measure.variant = model.variant;
    measure.time = utc_now();
    list_.change([&](std::vector<KeptMeasure>& measures) {
        measure.name = free_name(measures, measure.kind);
        measures.push_back(std::move(measure));
    });
    ++made_;
}

void MeasureList::take_back() {
    if (!first_ && made_ > 0) remove(all().size() - 1);
    begin_next();
}

void MeasureList::rename(std::size_t measure, const std::string& name) {
    if (all().at(measure).name == name) return;
    list_.change([&](std::vector<KeptMeasure>& measures) { measures[measure].name = name; });
}

void MeasureList::remove(std::size_t measure) {
    if (measure + 1 == all().size()) begin_next();
    if (measure + made_ >= all().size()) --made_;
    list_.change([&](std::vector<KeptMeasure>& measures) {
        measures.erase(measures.begin() + static_cast<std::ptrdiff_t>(measure));
    });
}

Vec3 middle_of(const KeptMeasure& measure) {
    if (measure.kind == MeasureKind::Diameter) return measure.points.front();
    Vec3 sum = Vec3::Zero();
    for (const Vec3& point : measure.points) sum += point;
    return sum / static_cast<double>(measure.points.size());
}

}  // namespace vesselbench
