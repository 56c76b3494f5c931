#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vessel/centerlines/vessel_diameter.h"
#include "workbench/session/stored_measures.h"
#include "workbench/window/case/stored_list.h"

namespace vesselbench {

/// What a measure is made on.
struct MeasuredModel {
    MeasuredOn on = MeasuredOn::Surface;
    StateId state = 0;
    std::string variant;

    bool operator==(const MeasuredModel&) const = default;
};

/// The measures of the project in the window, as StoredList keeps them, and the distance that is
/// being clicked. Undo and other edits leave them as they are.
class MeasureList {
public:
    /// \param wake as StoredList's
    explicit MeasureList(std::function<void()> wake);

    /// As StoredList's.
    void open(const std::filesystem::path& project, std::string read_only);
    std::string close();

    bool update() { return list_.update(); }

    [[nodiscard]] bool is_read() const { return list_.is_read(); }

    [[nodiscard]] bool pending() const { return list_.pending(); }

    [[nodiscard]] const std::vector<KeptMeasure>& all() const { return list_.all(); }

    [[nodiscard]] const std::string& not_stored() const { return list_.not_stored(); }

    /// A point that was clicked for a distance [mm]. The first one waits, the second makes a
    /// measure, "Distance 1", others lengthen it; a click on another model begins the next one.
    void click(const Vec3& point, const MeasuredModel& model);

    /// Keeps a diameter, "Diameter 1".
    void add(const VesselDiameter& diameter, const MeasuredModel& model);

    /// The next click begins another distance.
    void begin_next();

    /// True if there is a point that waits, or a measure that was made since the project was
    /// opened.
    [[nodiscard]] bool can_take_back() const { return first_ || made_ > 0; }

    /// Takes back the point that waits, else removes the newest of these measures.
    void take_back();

    /// The point of a distance that waits for its second one.
    [[nodiscard]] const std::optional<Vec3>& first_point() const { return first_; }

    /// True if the next click lengthens the newest measure.
    [[nodiscard]] bool lengthens() const { return lengthens_; }

    void rename(std::size_t measure, const std::string& name);
    void remove(std::size_t measure);

private:
    void keep(KeptMeasure measure, const MeasuredModel& model);
    void lengthen(const Vec3& point);

    StoredList<KeptMeasure> list_;
    std::optional<Vec3> first_;
    MeasuredModel model_;     ///< of the distance that is being clicked
    bool lengthens_ = false;  ///< the newest measure is that distance
    std::size_t made_ = 0;    ///< since the project was opened; they are the last ones
};

/// Where to look at a measure: the middle of its points [mm].
[[nodiscard]] Vec3 middle_of(const KeptMeasure& measure);

}  // namespace vesselbench
