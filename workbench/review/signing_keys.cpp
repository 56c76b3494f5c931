#include "workbench/review/signing_keys.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "workbench/review/signing_key.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

SigningKey& key_in(std::vector<SigningKey>& keys, const std::string& fingerprint) {
    const auto found = std::ranges::find(keys, fingerprint, &SigningKey::fingerprint);
    return found != keys.end() ? *found : keys.emplace_back(SigningKey{.fingerprint = fingerprint});
}

void add_once(std::vector<std::string>& list, const std::string& text) {
    if (std::ranges::count(list, text) == 0) list.push_back(text);
}

Json retirement_json(const std::optional<RetiredKey>& retired) {
    if (!retired) return {};
    return {{"time", retired->time}, {"author", retired->author}, {"reason", retired->reason}};
}

}  // namespace

std::vector<SigningKey> signing_keys(const std::vector<EnteredVerdicts>& entered,
                                     const std::vector<RetiredKey>& retired) {
    std::vector<SigningKey> keys;
    for (const EnteredVerdicts& file : entered) {
        if (file.key.empty()) continue;
        SigningKey& key = key_in(keys, key_fingerprint(file.key));
        ++key.files;
        add_once(key.reviewers, file.verdicts.reviewer);
        for (const std::string& principal : file.signature.principals)
            add_once(key.principals, principal);
    }
    for (const RetiredKey& one : retired) key_in(keys, one.fingerprint).retired = one;
    return keys;
}

Json keys_json(const std::vector<SigningKey>& keys) {
    Json list = Json::array();
    for (const SigningKey& key : keys)
        list.push_back({{"fingerprint", key.fingerprint},
                        {"reviewers", key.reviewers},
                        {"principals", key.principals},
                        {"files", key.files},
                        {"retired", retirement_json(key.retired)}});
    return list;
}

}  // namespace vesselbench
