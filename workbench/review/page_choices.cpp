#include "workbench/review/page_choices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/point_json.h"
#include "workbench/report/log_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Normals that differ by less are the same decision [deg].
constexpr double kSameDirection = 2.0;
/// Steeper turns are as wrong [deg].
constexpr double kMostTurn = 60.0;
constexpr double kDegrees = 57.29577951308232;

/// An argument by which an author decides about ends: a decision, an inlet, or a list, which all
/// name ends.
bool decides(const Parameter& parameter) {
    return parameter.use == Use::Decision || parameter.meaning == Meaning::Inlet ||
           parameter.type == ParameterType::List;
}

Arguments undecided(const Operation& operation, const Arguments& given) {
    Arguments left = given;
    for (const Parameter& parameter : operation.parameters)
        if (decides(parameter)) left.remove(parameter.name);
    return left;
}

/// In place of an author the operation takes what is likelier, instead of asking.
Arguments with_doubts_accepted(const Operation& operation, Arguments arguments) {
    if (const Parameter* doubts = parameter_of(operation, Meaning::Doubts))
        arguments.set(doubts->name, true);
    return arguments;
}

ByHand decided_by_hand(const Operation& operation, const Arguments& given) {
    ByHand by_hand;
    for (const Parameter& parameter : operation.parameters) {
        if (!given.has(parameter.name) || !decides(parameter)) continue;
        const bool inlet =
            parameter.meaning == Meaning::Inlet || parameter.meaning == Meaning::InletEnd;
        if (parameter.use == Use::Decision) by_hand = {true, true, true};
        (inlet ? by_hand.inlet : by_hand.ends) = true;
    }
    return by_hand;
}

double number_in(const Json& object, const char* key, double otherwise) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : otherwise;
}

/// Diameters and doubts are in the report, by name.
void add_figures(const Json& report, DecidedOpenings& decided) {
    const auto named = [&](const Json& name) {
        return std::ranges::find_if(decided.openings,
                                    [&](const DecidedOpening& o) { return name == o.name; });
    };
    for (const Json& opening : report.value("openings", Json::array()))
        if (const auto found = named(opening["name"]); found != decided.openings.end())
            found->diameter = number_in(opening, "diameter_mm", 0.0);
    for (const Json& end : report.value("ends", Json::array())) {
        if (const auto found = named(end["opening"]); found != decided.openings.end())
            found->direction_sd = number_in(end, "direction_sd_deg", 0.0);
        const Json& odds = end["odds"];
        decided.ends.push_back(
            {.place = point_from(end["place_mm"]),
             .diameter = number_in(end, "diameter_mm", 0.0),
             .opening = odds.is_object() ? number_in(odds, "opening", 0.5) : 0.5});
    }
}

/// Records that a run decided; none if it has decided none of this meaning.
std::vector<Arguments> decided_records(const Operation& operation, const ResultRecord& result,
                                       Meaning meaning) {
    const Parameter* parameter = parameter_of(operation, meaning);
    if (parameter == nullptr || !result.resolved.has(parameter->name)) return {};
    return result.resolved.records(parameter->name).list();
}

DecidedOpenings decided_in(const Operation& operation, const ResultRecord& result) {
    const auto planes = decided_records(operation, result, Meaning::Planes);
    const auto names = decided_records(operation, result, Meaning::Roles);
    DecidedOpenings decided;
    if (planes.empty() || names.empty()) return decided;
    for (std::size_t i = 0; i < std::min(planes.size(), names.size()); ++i)
        decided.openings.push_back({.name = names[i].text("name"),
                                    .inlet = names[i].is_word("kind", "inlet"),
                                    .tip = planes[i].point("tip"),
                                    .normal = planes[i].point("normal")});
    add_figures(reported(result), decided);
    return decided;
}

/// The opening of the same end: the nearest one, within the end's diameter.
const DecidedOpening* same_end(const std::vector<DecidedOpening>& openings,
                               const DecidedOpening& end) {
    const DecidedOpening* found = nullptr;
    double least = std::max(end.diameter, std::numeric_limits<double>::min());
    for (const DecidedOpening& opening : openings) {
        const double distance = (opening.tip - end.tip).norm();
        if (distance > least) continue;
        least = distance;
        found = &opening;
    }
    return found;
}

double odds_at(const std::vector<JudgedEnd>& ends, const Vec3& place) {
    const auto nearest = std::ranges::min_element(
        ends, {}, [&](const JudgedEnd& end) { return (end.place - place).norm(); });
    const bool meant =
        nearest != ends.end() && (nearest->place - place).norm() <= nearest->diameter;
    return meant ? nearest->opening : 0.5;
}

/// Beside the inlet; 1: unknown.
double width(const DecidedOpening& opening, double inlet) {
    return opening.diameter > 0.0 && inlet > 0.0 ? std::min(opening.diameter / inlet, 1.0) : 1.0;
}

/// A vessel that carries a small share of the inlet's flow is an unlikely inlet.
OtherChoice other_inlet(const DecidedOpening& own, const DecidedOpening* inlet) {
    const double share = inlet == nullptr ? 1.0 : std::pow(width(own, inlet->diameter), 3);
    std::string what = "the inlet was chosen by hand";
    if (own.diameter > 0.0) what += ", a vessel of " + formatted(own.diameter, "%.3g mm");
    if (inlet != nullptr)
        what += "; the program would take one of " + formatted(inlet->diameter, "%.3g mm");
    return {.what = what, .doubt = 1.0 - share, .place = own.tip};
}

/// The rim moves along the vessel by the turn's tangent, in radii.
std::optional<OtherChoice> other_direction(const DecidedOpening& given, const DecidedOpening& own) {
    const double angle = kDegrees * std::acos(std::clamp(given.normal.dot(own.normal), -1.0, 1.0));
    if (angle <= std::max(kSameDirection, own.direction_sd)) return std::nullopt;
    const double turn = std::min(angle, kMostTurn);
    return OtherChoice{.what = given.name + " is cut " + formatted(angle, "%.0f degrees") +
                               " off the direction that the program would choose",
                       .doubt = std::tan(turn / kDegrees),
                       .place = given.tip};
}

OtherChoice closed_end(const DecidedOpenings& own, const DecidedOpening& end, double widest) {
    return {.what = end.name + " stays closed; the program would open it",
            .doubt = odds_at(own.ends, end.tip) * width(end, widest),
            .place = end.tip};
}

OtherChoice opened_end(const DecidedOpenings& own, const DecidedOpening& end, double widest) {
    return {.what = end.name + " is opened; the program would leave it closed",
            .doubt = (1.0 - odds_at(own.ends, end.tip)) * width(end, widest),
            .place = end.tip};
}

}  // namespace

std::vector<OtherChoice> compared(const DecidedOpenings& given, const DecidedOpenings& own,
                                  const ByHand& by_hand) {
    const auto inlet = std::ranges::find_if(own.openings, &DecidedOpening::inlet);
    const DecidedOpening* entry = inlet == own.openings.end() ? nullptr : &*inlet;
    const double widest = entry == nullptr ? 0.0 : entry->diameter;
    std::vector<OtherChoice> others;
    for (const DecidedOpening& opening : own.openings) {
        const DecidedOpening* same = same_end(given.openings, opening);
        if (same == nullptr) {
            if (by_hand.ends) others.push_back(closed_end(own, opening, widest));
            continue;
        }
        if (by_hand.inlet && same->inlet && !opening.inlet)
            others.push_back(other_inlet(opening, entry));
        if (!by_hand.directions) continue;
        if (const auto turned = other_direction(*same, opening)) others.push_back(*turned);
    }
    for (const DecidedOpening& opening : given.openings)
        if (by_hand.ends && same_end(own.openings, opening) == nullptr)
            others.push_back(opened_end(own, opening, widest));
    return others;
}

std::vector<OtherChoice> other_choices(Session& session, const LogEntry& entry,
                                       const Operation& operation, const Progress& progress) {
    if (!entry.result || parameter_of(operation, Meaning::Planes) == nullptr) return {};
    const Arguments left = undecided(operation, entry.edit.given);
    if (left == entry.edit.given) return {};
    try {
        const Preview own = session.preview_change(
            entry.edit.edit.id, with_doubts_accepted(operation, left), {}, progress);
        return compared(decided_in(operation, *entry.result), decided_in(operation, own.result()),
                        decided_by_hand(operation, entry.edit.given));
    } catch (const AlgorithmFailure&) {  // it finds no openings by itself
        return {};
    } catch (const UsageError&) {
        return {};
    }
}

}  // namespace vesselbench
