#include "tests/soak/random_arguments.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"

namespace vesselbench::soak {

namespace {

using forest::Dice;

template <class List>
const auto& one_of(const List& list, Dice& dice) {
    return list[dice.whole(0, static_cast<int>(list.size()) - 1)];
}

/// A tube along x, with a ball in its middle: two ends and a sac.
double lumen(const Vec3& p) {
    const double tube = 2.5 - std::hypot(p.y(), p.z());
    const double sac = 4.0 - (p - Vec3(0, 4, 0)).norm();
    return 50.0 + 25.0 * std::clamp(std::max(tube, sac), -2.0, 2.0);
}

Image lumen_image() {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.diagonal() << 1.0, 1.0, 1.0, 1.0;
    matrix.col(3).head<3>() << -10.0, -6.0, -6.0;
    return test::image_of({21, 17, 13}, matrix, lumen);
}

Image mask_of(const Image& image) {
    std::vector<float> labels;
    for (const float value : *image.voxels) labels.push_back(value > 50.0F ? 1.0F : 0.0F);
    Image mask = image;
    mask.voxels = std::make_shared<const std::vector<float>>(std::move(labels));
    return mask;
}

/// The arguments of one edit in the making.
class Draw {
public:
    Draw(const Operation& operation, const Scene& scene, const SmallFiles& files, Dice& dice)
        : operation_(operation), scene_(scene), files_(files), dice_(dice) {}

    Arguments all() {
        choose_forms();
        for (const Parameter& parameter : operation_.parameters)
            if (!left_out_.contains(parameter.name) &&
                (parameter.required || needed_.contains(parameter.name) || dice_.chance(kShare)))
                add(parameter);
        for (const char* name : {"name", "kind"})  // of one opening
            if (drawn_.has(name) && has("tip") && !drawn_.has("tip")) drawn_.set("tip", place());
        return drawn_;
    }

private:
    static constexpr double kShare = 0.25;    // of the optional parameters
    static constexpr double kOdd = 0.04;      // of values that fit nothing
    static constexpr double kExtreme = 0.04;  // of numbers at the end of their range

    [[nodiscard]] bool has(const std::string& name) const {
        return std::ranges::any_of(operation_.parameters,
                                   [&](const Parameter& p) { return p.name == name; });
    }

    /// Where arguments exclude each other, takes one form; rarely both.
    void choose_forms() {
        struct Form {
            const char* name;
            std::vector<std::string> with;
        };

        static const std::vector<std::pair<Form, Form>> forms = {
            {{"at", {"radius", "strength", "falloff"}}, {"dabs", {}}},
            {{"centre", {"radius"}}, {"box", {}}},
            {{"file", {}}, {"labels", {}}},
            {{"share", {}}, {"triangles", {}}}};
        for (const auto& [first, second] : forms) {
            if (!has(first.name) || !has(second.name) || dice_.chance(kOdd)) continue;
            const bool swapped = dice_.chance(0.4);
            const Form &taken = swapped ? second : first, &left = swapped ? first : second;
            left_out_.insert(left.name);
            left_out_.insert(left.with.begin(), left.with.end());
            needed_.insert(taken.name);
            if (!taken.with.empty()) needed_.insert(taken.with.front());
        }
        if (scene_.neighbours.empty() && dice_.chance(1.0 - kOdd))
            left_out_.insert({"distance", "neighbours", "margin", "omega"});
    }

    void add(const Parameter& parameter) {
        // Replays give them, users hardly.
        if (parameter.use == Use::Decision && !dice_.chance(kOdd)) return;
        if (parameter.name == "device") return;  // results of a GPU are equal to a tolerance only
        if (parameter.only_with && left_out_.contains(parameter.only_with->parameter)) return;
        if (parameter.only_with && !drawn_.has(parameter.only_with->parameter))
            drawn_.set(parameter.only_with->parameter, met(*parameter.only_with));
        drawn_.set(parameter.name, value(parameter));
    }

    /// A value with which the condition most likely holds.
    Value met(const Condition& condition) {
        if (!condition.values.empty()) return one_of(condition.values, dice_);
        return value(find_parameter(operation_, condition.parameter));
    }

    Value value(const Parameter& parameter) {
        switch (parameter.type) {
            case ParameterType::Flag:
                return dice_.chance(0.5);
            case ParameterType::Integer:
                return integer(parameter);
            case ParameterType::Real:
                return real(parameter);
            case ParameterType::Text:
                return text(parameter.meaning);
            case ParameterType::Choice:
                return one_of(parameter.choices, dice_);
            case ParameterType::Point:
                return point(parameter);
            case ParameterType::List:
                return list(parameter);
            case ParameterType::Records:
                return records(parameter);
            default:
                return files_.one_for(operation_, parameter.name, dice_);
        }
    }

    Value records(const Parameter& parameter) {
        std::vector<Arguments> drawn;
        for (int left = dice_.whole(1, 3); left > 0; --left) {
            Arguments record;
            for (const Parameter& field : parameter.fields) record.set(field.name, value(field));
            drawn.push_back(std::move(record));
        }
        return Records(std::move(drawn));
    }

    std::int64_t integer(const Parameter& parameter) {
        const double low = std::max(parameter.minimum, -3.0);
        if (dice_.chance(kExtreme)) return static_cast<std::int64_t>(low);
        const double high = std::min(parameter.maximum, low + (dice_.chance(0.8) ? 3.0 : 9.0));
        return dice_.whole(static_cast<int>(low), static_cast<int>(high));
    }

    double real(const Parameter& parameter) {
        const double low = parameter.minimum, high = parameter.maximum;
        if (dice_.chance(kExtreme) && std::isfinite(low) && !parameter.above_minimum) return low;
        if (dice_.chance(kExtreme) && std::isfinite(high) && high <= 100.0) return high;
        double drawn = dice_.log_between(0.1, 8.0);
        if (parameter.default_value)
            if (const double* usual = std::get_if<double>(&*parameter.default_value))
                drawn = *usual * dice_.log_between(0.4, 2.5);
        if (std::isfinite(low) && std::isfinite(high) && high - low <= 4.0)
            drawn = dice_.between(low, high);
        return std::clamp(drawn, parameter.above_minimum ? std::nextafter(low, high) : low, high);
    }

    Vec3 on_surface() {
        if (!scene_.surface || scene_.surface->empty())
            return {dice_.between(-9, 9), dice_.between(-5, 5), dice_.between(-5, 5)};
        return one_of(scene_.surface->points(), dice_);
    }

    Vec3 place() {
        if (dice_.chance(kOdd)) return 1000.0 * dice_.direction();
        return on_surface() + (dice_.chance(0.3) ? 2.0 : 0.0) * dice_.direction();
    }

    Value point(const Parameter& parameter) {
        if (parameter.unit == "mm" && parameter.minimum < 0.0) return place();
        if (parameter.minimum >= 0.0)
            return Vec3(dice_.between(0.2, 2), dice_.between(0.2, 2), dice_.between(0.2, 2));
        return dice_.direction();
    }

    std::vector<std::string> names() {
        std::vector<std::string> found = {"a", "b-2.c", "painted_weight", "bone"};
        if (!scene_.surface) return found;
        for (const Patch& patch : scene_.surface->patches)
            for (int times = 0; times < 3; ++times) found.push_back(patch.name);
        for (const auto& [name, values] : scene_.surface->attributes) found.push_back(name);
        for (const auto& [name, surface] : scene_.neighbours) found.push_back(name);
        return found;
    }

    std::string text(Meaning meaning) {
        std::string words = one_of(names(), dice_);
        const bool several = meaning == Meaning::Names || meaning == Meaning::Openings;
        if (several && dice_.chance(0.4)) words += "," + one_of(names(), dice_);
        return words;
    }

    std::vector<double> list(const Parameter& parameter) {
        switch (parameter.meaning) {
            case Meaning::Labels:
                return dice_.chance(0.8) ? std::vector<double>{1} : std::vector<double>{1, 2};
            case Meaning::Box:
                return box();
            default:
                return numbers(10 * dice_.whole(0, 2) + 3 * dice_.whole(0, 2));
        }
    }

    std::vector<double> box() {
        const Vec3 a = on_surface(), b = on_surface();
        const Vec3 low = a.cwiseMin(b) - Vec3::Constant(dice_.between(0, 3));
        const Vec3 high = a.cwiseMax(b) + Vec3::Constant(dice_.between(0, 3));
        return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
    }

    std::vector<double> numbers(int count) {
        std::vector<double> all;
        for (; count > 0; --count) all.push_back(dice_.between(-9, 9));
        return all;
    }

    const Operation& operation_;
    const Scene& scene_;
    const SmallFiles& files_;
    Dice& dice_;
    std::set<std::string> left_out_, needed_;
    Arguments drawn_;
};

}  // namespace

SmallFiles::SmallFiles(std::filesystem::path folder) : folder_(std::move(folder)) {
    if (std::filesystem::exists(folder_ / "mask.nrrd")) return;
    std::filesystem::create_directories(folder_);
    const auto path = [&](const char* name) { return (folder_ / name).string(); };
    write_surface(test::open_tube(2.0, 12.0, 14, 12), path("open.stl"));
    write_surface(test::closed_tube(2.0, 16.0, 16, 16), path("closed.vtp"));
    write_surface(test::icosphere(4.0, 2), path("ball.ply"));
    write_image(path("lumen.nrrd"), lumen_image());
    write_image(path("mask.nrrd"), mask_of(lumen_image()));
}

std::string SmallFiles::one_for(const Operation& operation, const std::string& parameter,
                                Dice& dice) const {
    if (operation.recipe.loads != InputKind::Image)
        return (folder_ / one_of(std::vector{"open.stl", "closed.vtp", "ball.ply"}, dice)).string();
    const bool labels = parameter == "mask" || dice.chance(0.2);
    return (folder_ / (labels ? "mask.nrrd" : "lumen.nrrd")).string();
}

Arguments random_arguments(const Operation& operation, const Scene& scene, const SmallFiles& files,
                           Dice& dice) {
    return Draw(operation, scene, files, dice).all();
}

}  // namespace vesselbench::soak
