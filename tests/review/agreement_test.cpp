#include "workbench/review/agreement.h"

#include <catch2/catch.hpp>

using namespace vesselbench;

namespace {

/// One text an observer, a letter a unit; '.': no value.
std::vector<RatedUnit> units_of(const std::vector<std::string>& observers) {
    std::vector<RatedUnit> units(observers.front().size());
    for (const std::string& values : observers)
        for (std::size_t i = 0; i < values.size(); ++i)
            if (values[i] != '.') units[i].emplace_back(1, values[i]);
    return units;
}

}  // namespace

SCENARIO("Krippendorff's alpha has the values of his examples", "[review][agreement]") {
    // Krippendorff, "Computing Krippendorff's alpha-reliability", 2011, examples A, B and C.
    CHECK(krippendorff_alpha(units_of({"0100000010", "1110010000"})).value() ==
          Approx(0.095).margin(0.0005));
    CHECK(krippendorff_alpha(units_of({"aabbdcccedda", "babbbccceddd"})).value() ==
          Approx(0.692).margin(0.0005));
    CHECK(krippendorff_alpha(
              units_of({"123321412...", "1233224125.3", ".3332342251.", "12332441251."}))
              .value() == Approx(0.743).margin(0.0005));
}

SCENARIO("Agreement has limits", "[review][agreement]") {
    CHECK_FALSE(krippendorff_alpha({}).has_value());
    CHECK_FALSE(krippendorff_alpha(units_of({"aaaa", "aaaa"})).has_value());
    CHECK_FALSE(krippendorff_alpha(units_of({"ab", ".."})).has_value());
    CHECK(krippendorff_alpha(units_of({"abab", "abab"})).value() == Approx(1.0));
    CHECK(krippendorff_alpha(units_of({"ab", "ba"})).value() < 0.0);
    CHECK(observed_agreement(units_of({"0100000010", "1110010000"})).value() == Approx(0.6));
    THEN("there are too few units below 30") {
        const Agreement few = agreement_of(units_of({std::string(29, 'a'), std::string(29, 'b')}));
        CHECK(few.units == 29);
        CHECK(few.share.value() == 0.0);
        CHECK_FALSE(few.alpha.has_value());
    }
    THEN("the interval holds alpha, and is the same for the same seed") {
        std::string one, other;
        for (int i = 0; i < 60; ++i) {
            one += i % 3 == 0 ? 'a' : 'b';
            other += i % 5 == 0 ? 'a' : one.back();
        }
        const Agreement found = agreement_of(units_of({one, other}));
        CHECK(found.units == 60);
        CHECK(found.values == 120);
        CHECK(found.alpha.value() == Approx(0.725).margin(0.001));
        // 1 minus observed over expected disagreement, drawn 4,000 times by another generator.
        CHECK(found.lower.value() == Approx(0.542).margin(0.03));
        CHECK(found.upper.value() == Approx(0.892).margin(0.03));
        CHECK(found.lower == agreement_of(units_of({one, other})).lower);
    }
    THEN("one disagreement, which many draws miss, gives no interval") {
        const std::string accepts(39, 'a');
        const Agreement found = agreement_of(units_of({"a" + accepts, "r" + accepts}));
        CHECK(found.share.value() == Approx(39.0 / 40.0));
        CHECK(found.alpha.value() == Approx(0.0).margin(0.05));
        CHECK_FALSE(found.lower.has_value());
        CHECK_FALSE(found.upper.has_value());
    }
}
