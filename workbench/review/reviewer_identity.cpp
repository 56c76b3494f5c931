#include "workbench/review/reviewer_identity.h"

#include <map>

#include "workbench/review/reviewer_name.h"

namespace vesselbench {

namespace {

/// Texts that stand for one and the same: a forest in which each is its own root at first.
class EqualTexts {
public:
    /// The text that stands for all that were joined with this one.
    [[nodiscard]] std::string root(const std::string& text) const {
        const auto found = parents_.find(text);
        return found == parents_.end() ? text : root(found->second);
    }

    void join(const std::string& a, const std::string& b) {
        if (const std::string from = root(b), to = root(a); from != to) parents_[from] = to;
    }

private:
    std::map<std::string, std::string> parents_;
};

std::string name_id(const EnteredVerdicts& file) {
    return "name " + compared_name(file.verdicts.reviewer);
}

/// What a file was signed with: the principals of the key, or the key; empty: not signed, or by a
/// signature that does not verify.
std::vector<std::string> signer_ids(const EnteredVerdicts& file) {
    std::vector<std::string> ids;
    if (file.signature.state == SignatureState::Verified)
        for (const std::string& principal : file.signature.principals)
            ids.push_back("principal " + principal);
    if (file.signature.state == SignatureState::Unverified && !file.key.empty())
        ids.push_back("key " + file.key);
    return ids;
}

}  // namespace

std::vector<ReviewerIdentity> identities_of(const std::vector<EnteredVerdicts>& files) {
    EqualTexts signers, persons;
    std::map<std::string, std::string> bound;  // names to who first signed under them
    for (const EnteredVerdicts& file : files) {
        const std::vector<std::string> ids = signer_ids(file);
        for (const std::string& id : ids) signers.join(ids.front(), id);
        if (!ids.empty()) bound.try_emplace(name_id(file), ids.front());
    }
    std::vector<ReviewerIdentity> made;
    for (const EnteredVerdicts& file : files) {
        const std::vector<std::string> ids = signer_ids(file);
        const std::string name = name_id(file);
        const auto owner = bound.find(name);
        const std::string giver = !ids.empty()           ? ids.front()
                                  : owner == bound.end() ? name
                                                         : owner->second;
        made.push_back({.giver = signers.root(giver), .is_signed = !ids.empty()});
        persons.join(made.back().giver, name);
    }
    for (ReviewerIdentity& identity : made) identity.person = persons.root(identity.giver);
    return made;
}

}  // namespace vesselbench
