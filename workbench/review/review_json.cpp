#include "workbench/review/review_json.h"

#include <nlohmann/json.hpp>

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

const char* state_word(SignatureState state) {
    switch (state) {
        case SignatureState::Unverified:
            return "unverified";
        case SignatureState::Verified:
            return "verified";
        case SignatureState::Invalid:
            return "invalid";
        case SignatureState::None:
            break;
    }
    return "none";
}

Json verdict_json(const GivenVerdict& given) {
    return {{"reviewer", given.reviewer}, {"role", given.role},
            {"time", given.time},         {"verdict", to_string(given.verdict)},
            {"comment", given.comment},   {"revision", given.revision},
            {"outdated", given.outdated}, {"signature", signature_json(given.signature)}};
}

}  // namespace

Json signature_json(const Signature& signature) {
    return {{"state", state_word(signature.state)},
            {"signer", signature.signer},
            {"problem", signature.problem}};
}

Json verdicts_json(const std::vector<GivenVerdict>& verdicts) {
    Json list = Json::array();
    for (const GivenVerdict& given : verdicts) list.push_back(verdict_json(given));
    return list;
}

Json review_json(const Review& review) {
    Json edits = Json::array();
    for (const ReviewedEdit& edit : review.edits)
        edits.push_back({{"edit", edit.edit.id},
                         {"revision", edit.edit.revision},
                         {"step", to_string(edit.place.step)},
                         {"variant", edit.place.variant},
                         {"operation", edit.operation},
                         {"hash", edit.hash},
                         {"status", to_string(edit.status)},
                         {"verdicts", verdicts_json(edit.verdicts)}});
    return {{"status", review.files == 0 ? "not reviewed" : to_string(status_of(review))},
            {"summary", review_words(review)},
            {"files", review.files},
            {"edits", edits},
            {"overall", verdicts_json(review.overall)}};
}

}  // namespace vesselbench
