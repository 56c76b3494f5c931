#include "workbench/review/verdict_import.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"
#include "workbench/case/version.h"
#include "workbench/project/chain.h"
#include "workbench/project/content_hash.h"
#include "workbench/project/project.h"
#include "workbench/project/utc_time.h"
#include "workbench/review/import_checks.h"
#include "workbench/review/retired_keys.h"
#include "workbench/review/review.h"
#include "workbench/review/signing_key.h"

namespace vesselbench {

namespace {

/// \param signature empty: none
std::string facts_of(const VerdictFile& file, const std::string& signature,
                     const Signature& known) {
    nlohmann::ordered_json edits = nlohmann::ordered_json::object();
    for (const EditVerdict& verdict : file.edits)
        edits[std::to_string(verdict.edit.id) + "." + std::to_string(verdict.edit.revision)] =
            to_string(verdict.verdict);
    nlohmann::ordered_json facts = {{"reviewer", file.reviewer},
                                    {"role", file.role},
                                    {"written", file.written},
                                    {"chain_head", file.chain_head},
                                    {"overall", to_string(file.overall)},
                                    {"edits", edits}};
    if (!signature.empty()) facts["signature"] = hash_of_text(signature);
    if (!known.signer.empty()) facts["signer"] = known.signer;
    return text_from_json(facts);
}

/// \throw InvalidInput if the signature is by a key that was retired
void check_not_retired(const std::string& signature, const std::string& name,
                       const ProjectFile& project) {
    const std::string key = signing_key(signature);
    if (key.empty()) return;
    const std::vector<RetiredKey> keys = retired_keys(project);
    if (const RetiredKey* retired = find_retired(keys, key_fingerprint(key)))
        throw InvalidInput(name + " cannot be entered: " + retired_words(*retired) +
                           "; sign it with another key");
}

/// True if a project has what a file says, signed or not.
bool has_verdicts(std::span<const EnteredVerdicts> entered, const std::string& text) {
    return std::ranges::any_of(
        entered, [&](const EnteredVerdicts& one) { return text_of(one.verdicts) == text; });
}

/// \throw InvalidInput if a required signature is missing or does not verify
void check_signature(const Signature& signature, bool required, const std::string& name) {
    if (signature.state == SignatureState::Invalid)
        throw InvalidInput(name + ": " + signature_words(signature) + "; nothing was entered");
    if (required && signature.state == SignatureState::None)
        throw InvalidInput(name + " is not signed: there is no " + name +
                           ".sig beside it; without --signers it is entered as unsigned");
}

std::size_t outdated_in(const VerdictFile& file, const Session& session) {
    std::set<std::string> current;
    for (const LogEntry& entry : session.log()) current.insert(edit_hash(session.project(), entry));
    return static_cast<std::size_t>(
        std::ranges::count_if(file.edits, [&](const EditVerdict& verdict) {
            return verdict.verdict != Verdict::None && !current.contains(verdict.hash);
        }));
}

/// \param given with the bytes that were signed, if they were
/// \param name of the verdicts in error texts
ImportedVerdicts enter(Session& session, StoredVerdicts given, const Signature& signature,
                       const std::string& name) {
    ImportedVerdicts done{.verdicts = verdicts_from_text(given.text, name), .signature = signature};
    const std::vector<EnteredVerdicts> entered = entered_verdicts(session.project());
    check_before_entering(done.verdicts, name, session, entered);
    check_not_retired(given.signature, name, session.project());
    const std::string facts = facts_of(done.verdicts, given.signature, signature);
    if (given.signature.empty()) given.text = text_of(done.verdicts);
    done.known = given.signature.empty() && has_verdicts(entered, given.text);
    if (!done.known)
        done.known = !session.add_verdicts(
            given, hash_of_text(given.text + given.signature),
            {.kind = kVerdictsEntered, .subject = done.verdicts.reviewer, .facts = facts});
    done.outdated = outdated_in(done.verdicts, session);
    return done;
}

/// \param said verdicts, to which time, reviewer and origin are added
ImportedVerdicts enter_now(Session& session, const Reviewer& reviewer, VerdictFile said) {
    const ProjectFile& project = session.project();
    said.program = version();
    said.project = project.id();
    said.project_name = project.name();
    said.chain_head = project.record_head();
    said.reviewer = reviewer.name;
    said.role = reviewer.role;
    said.written = utc_now();
    for (EditVerdict& verdict : said.edits) verdict.time = said.written;
    const std::string name = "the verdict";
    return enter(session, {text_of(said), ""}, {}, name);
}

}  // namespace

std::string imported_words(const ImportedVerdicts& imported) {
    const std::string by = printable(imported.verdicts.reviewer);
    if (imported.known) return "these verdicts of " + by + " are entered already";
    const VerdictFile& verdicts = imported.verdicts;
    std::vector<std::string> what;
    if (verdicts.said() > 0 || verdicts.overall == Verdict::None)
        what.push_back(counted(verdicts.said(), "verdict"));
    if (verdicts.overall != Verdict::None) what.emplace_back("one on the whole model");
    std::string words = enumerated(what) + " of " + by;
    if (imported.signature.state != SignatureState::None)
        words += ", " + printable(signature_words(imported.signature));
    if (imported.outdated > 0)
        words += ", " + std::to_string(imported.outdated) + " of them on what has changed since";
    return words;
}

ImportedVerdicts import_verdicts(Session& session, const std::filesystem::path& file,
                                 const std::filesystem::path& signers, const Progress& progress) {
    const std::string name = bare_name(file);
    StoredVerdicts given{verdict_text_in(file), signature_beside(file)};
    const Signature signature = signers.empty() ? checked_signature(given, progress)
                                                : signature_of(given, signers, progress);
    check_signature(signature, !signers.empty(), name);
    return enter(session, std::move(given), signature, name);
}

ImportedVerdicts enter_verdict(Session& session, const Reviewer& reviewer, EditVerdict verdict) {
    return enter_now(session, reviewer, {.edits = {std::move(verdict)}});
}

ImportedVerdicts enter_overall(Session& session, const Reviewer& reviewer, const Review& seen,
                               Verdict verdict, const std::string& comment) {
    VerdictFile said{.overall = verdict, .overall_comment = comment};
    for (const ReviewedEdit& edit : seen.edits)
        said.edits.push_back({.edit = edit.edit, .hash = edit.hash});
    return enter_now(session, reviewer, std::move(said));
}

}  // namespace vesselbench
