#include "workbench/flow/methods_text.h"

#include <algorithm>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

std::string inlets_text(const FlowResults& results) {
    std::vector<std::string> texts;
    for (const OpeningFigures& opening : results.openings) {
        const RecordedOpening& recorded = opening.recorded;
        if (recorded.kind != PatchKind::Inlet) continue;
        std::string text = recorded.name + formatted(opening.flow, " (%.4g ml/s") +
                           formatted(recorded.diameter, ", diameter %.3g mm");
        if (recorded.reynolds) text += formatted(*recorded.reynolds, ", Reynolds number %.0f");
        texts.push_back(text + ")");
    }
    return enumerated(texts);
}

std::string fluid_text(const FlowRecord& record) {
    const std::string density = formatted(record.density, "density %g kg/m^3");
    if (!record.carreau)
        return "incompressible Newtonian fluid (" + density +
               formatted(record.viscosity, ", dynamic viscosity %g Pa s)");
    return "incompressible fluid of " + density + " with the viscosity of Carreau's model" +
           formatted(carreau::kAtRest, " (%g Pa s at rest,") +
           formatted(carreau::kAtShear, " %g Pa s at high shear rates,") +
           formatted(carreau::kTime, " lambda %g s,") + formatted(carreau::kExponent, " n %g [4])");
}

std::string outlets_text(const FlowRecord& record) {
    if (!record.given_outflows)
        return "; the pressure was 0 at all outlets, where backflow entered at rest. ";
    return "; the outlets' flows were prescribed" +
           (record.outflow_rule.empty() ? "" : " " + record.outflow_rule) + ", but at " +
           rest_outlet_text() + ", whose pressure was 0. ";
}

std::string pulse_text(const FlowResults& results) {
    const RecordedWaveform& wave = *results.flow.record.waveform;
    std::string text = "The inflow followed a " +
                       std::string(wave.synthetic ? "synthetic (not measured)" : "given") +
                       " waveform with a period of" + formatted(wave.period, " %g s") + ", in " +
                       std::to_string(wave.steps) + " steps; " +
                       counted(static_cast<std::size_t>(wave.periods), "period") +
                       " computed from rest, of which the last one was evaluated.";
    if (results.period_change)
        text += " The wall's mean shear stress changed by" +
                formatted(100.0 * *results.period_change, " %.2g %%") + " from the period before.";
    return text;
}

std::string solver_text(const FlowResults& results) {
    const bool pulsatile = results.flow.record.waveform.has_value();
    return solver_name(pulsatile) + " of " + results.solver +
           (pulsatile ? " [1] (PIMPLE algorithm with SIMPLEC's corrections [2], schemes of second "
                        "order in space, Euler's in time)"
                      : " [1] (SIMPLEC algorithm [2], second-order schemes)");
}

/// What the wall shear stress is of; its references follow the others.
std::string average_text(const FlowRecord& record) {
    if (!record.waveform) return "It is of a steady flow, and no average over a cardiac cycle.";
    const int first = record.carreau ? 5 : 4;
    const auto reference = [&](int which) { return " [" + std::to_string(first + which) + "]"; };
    return "It is averaged over the last period: TAWSS is the mean of its magnitude, OSI = 0.5 (1 "
           "- |mean vector| / TAWSS)" +
           reference(0) + ", RRT = 1 / ((1 - 2 OSI) TAWSS)" + reference(1) +
           ", ECAP = OSI / TAWSS" + reference(2) + ".";
}

std::string run_end_text(const FlowResults& results) {
    if (results.flow.record.waveform) return pulse_text(results);
    const SettlingLimits limits;
    if (results.settling.settled)
        return "The iterations ended when pressures, flows and the mean wall shear stress had "
               "changed by less than" +
               formatted(100.0 * limits.change, " %g %%") + " over " +
               std::to_string(limits.window) + " iterations and all initial residuals were below" +
               formatted(limits.residual, " %g") + ": after " + time_name(results.time) +
               " iterations (largest residual" + formatted(results.settling.residual, " %.1e") +
               ").";
    return results.converged
               ? "The iterations ended when the residual control was reached: after " +
                     time_name(results.time) + " iterations."
               : "The solution had NOT converged when it ended after " + time_name(results.time) +
                     " iterations (largest residual" +
                     formatted(results.settling.residual, " %.1e") + ").";
}

}  // namespace

std::string methods_text(const FlowResults& results) {
    const FlowRecord& record = results.flow.record;
    return "The flow was computed as " + std::string(record.waveform ? "pulsatile" : "steady") +
           ", laminar flow of an " + fluid_text(record) +
           " through rigid walls without slip, with the finite-volume solver " +
           solver_text(results) + ", on a mesh of " + std::to_string(record.cells) + " cells. " +
           (record.parabolic ? "The profile of developed laminar flow" : "A uniform velocity") +
           " was prescribed at " + inlets_text(results) + outlets_text(record) +
           run_end_text(results) + " The imbalance of mass was" +
           formatted(100.0 * results.imbalance, " %.2g %%") +
           " of the inflow. Wall shear stress is the tangential stress that the blood exerts on "
           "the "
           "wall; means and percentiles are weighted by area, over the vessel's own wall without "
           "its extensions. " +
           average_text(record) + " Low wall shear stress is below" +
           formatted(kLowShear, " %g Pa [3].");
}

std::vector<std::string> method_references(const FlowResults& results) {
    std::vector<std::string> references = {
        "Weller HG, Tabor G, Jasak H, Fureby C. A tensorial approach to computational continuum "
        "mechanics using object-oriented techniques. Computers in Physics 12 (1998), 620-631.",
        "Van Doormaal JP, Raithby GD. Enhancements of the SIMPLE method for predicting "
        "incompressible fluid flows. Numerical Heat Transfer 7 (1984), 147-163.",
        "Malek AM, Alper SL, Izumo S. Hemodynamic shear stress and its role in atherosclerosis. "
        "JAMA 282 (1999), 2035-2042."};
    if (results.flow.record.carreau)
        references.emplace_back(
            "Cho YI, Kensey KR. Effects of the non-Newtonian viscosity of blood on flows in a "
            "diseased arterial vessel. Part 1: Steady flows. Biorheology 28 (1991), 241-262.");
    if (results.flow.record.waveform)
        references.insert(
            references.end(),
            {"He X, Ku DN. Pulsatile flow in the human left coronary artery bifurcation: average "
             "conditions. Journal of Biomechanical Engineering 118 (1996), 74-82.",
             "Himburg HA, Grzybowski DM, Hazel AL, LaMack JA, Li XM, Friedman MH. Spatial "
             "comparison between wall shear stress measures and porcine arterial endothelial "
             "permeability. American Journal of Physiology 286 (2004), H1916-H1922.",
             "Di Achille P, Tellides G, Figueroa CA, Humphrey JD. A haemodynamic predictor of "
             "intraluminal thrombus formation in abdominal aortic aneurysms. Proceedings of the "
             "Royal Society A 470 (2014), 20140163."});
    return references;
}

}  // namespace vesselbench
