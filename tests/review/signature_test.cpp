#include "workbench/review/signature.h"

#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/review/reviewed_session.h"
#include "tests/session/small_operations.h"
#include "tests/session/sphere_session.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/signing.h"
#include "workbench/project/chain.h"
#include "workbench/project/database.h"
#include "workbench/project/project.h"
#include "workbench/project/record_check.h"
#include "workbench/review/audit.h"
#include "workbench/review/audit_texts.h"
#include "workbench/review/retired_keys.h"
#include "workbench/review/signing_key.h"
#include "workbench/review/signing_keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kKern = "kern@clinic.example";

/// Verdicts that A. Kern signed, beside a project.
struct SignedReview {
    std::string project = reviewed_project();
    std::string key = new_signing_key();
    std::string signers = allowed_signers(allowed_line(kKern, key));
    std::string file = [this] {
        const Session session = Session::open(project, options());
        const std::string saved =
            save_verdicts(project, verdicts_on(session, "A. Kern", Verdict::Accept));
        write_file(saved, file_content(saved) + "\n \n");  // the bytes that count are the file's
        sign(saved, key);
        return saved;
    }();

    [[nodiscard]] StoredVerdicts stored() const {
        return {file_content(file), signature_beside(file)};
    }
};

Signature imported(const SignedReview& review, const std::string& signers) {
    Session session = Session::open(review.project, options());
    return import_verdicts(session, review.file, signers).signature;
}

std::string import_error(const SignedReview& review, const std::string& signers) {
    try {
        imported(review, signers);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "entered";
}

Audit audited(const std::string& project, const std::string& signers) {
    return audit({.project = project,
                  .signers = signers,
                  .find = find_test_operation,
                  .worker = test_worker()});
}

bool says(const std::vector<std::string>& texts, const std::string& part) {
    return std::ranges::any_of(
        texts, [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

}  // namespace

SCENARIO("A signature is verified against allowed signers", "[review][signature]") {
    if (!can_sign()) return;
    const SignedReview review;
    const auto problem = [&](const StoredVerdicts& verdicts, const std::string& signers) {
        const Signature found = signature_of(verdicts, signers);
        CHECK(found.state == SignatureState::Invalid);
        CHECK(found.signer.empty());
        CHECK_THAT(found.problem, !Contains("/"));
        return found.problem;
    };
    const Signature good = signature_of(review.stored(), review.signers);
    CHECK(good.state == SignatureState::Verified);
    CHECK(good.signer == kKern);
    CHECK(signature_words(good) == "signed by kern@clinic.example");
    CHECK(signature_of(review.stored(), "").state == SignatureState::Unverified);
    CHECK(signature_of({review.stored().text, ""}, review.signers).state == SignatureState::None);
    THEN("one of other bytes does not verify") {
        StoredVerdicts other = review.stored();
        other.text += " ";
        CHECK_THAT(problem(other, review.signers), Contains("incorrect signature"));
    }
    THEN("one for another purpose does not verify") {
        sign(review.file, review.key, "git");
        CHECK_THAT(problem(review.stored(), review.signers), Contains("namespace"));
    }
    THEN("one by a key that is not allowed does not verify") {
        sign(review.file, new_signing_key());
        CHECK_THAT(problem(review.stored(), review.signers), Contains("No principal matched"));
        CHECK_FALSE(problem(review.stored(), allowed_signers("")).empty());
        CHECK_FALSE(problem(review.stored(), allowed_signers("no line of such a file\n")).empty());
    }
    THEN("a key allowed for another purpose only does not verify") {
        CHECK_FALSE(problem(review.stored(),
                            allowed_signers(allowed_line(kKern, review.key, "namespaces=\"git\"")))
                        .empty());
    }
    THEN("the key has to be valid when the verdicts were entered") {
        const std::string expired =
            allowed_signers(allowed_line(kKern, review.key, "valid-before=\"20200101\""));
        CHECK_THAT(problem(review.stored(), expired), Contains("expired"));
        StoredVerdicts entered = review.stored();
        entered.time = "2019-12-31T12:00:00Z";
        CHECK(signature_of(entered, expired).state == SignatureState::Verified);
        entered.time = "2020-01-01T00:00:01Z";
        CHECK(signature_of(entered, expired).state == SignatureState::Invalid);
        entered.time = "yesterday";
        CHECK_THROWS_AS(signature_of(entered, expired), InvalidInput);
    }
    THEN("all principals of a key are named, one of several lines is enough") {
        CHECK(signature_of(review.stored(),
                           allowed_signers("# reviewers\n" +
                                           allowed_line("roth@clinic.example", new_signing_key()) +
                                           allowed_line("kern,a.kern", review.key)))
                  .signer == "kern, a.kern");
    }
    THEN("what only looks like a signature does not verify") {
        StoredVerdicts other = review.stored();
        other.signature = "-----BEGIN SSH SIGNATURE-----\nAAAA\n-----END SSH SIGNATURE-----\n";
        CHECK_FALSE(problem(other, review.signers).empty());
        other.signature = review.stored().signature;
        other.signature[other.signature.size() / 2] ^= 1;
        CHECK_FALSE(problem(other, review.signers).empty());
    }
    THEN("allowed signers that cannot be read are named") {
        CHECK_THROWS_AS(signature_of(review.stored(), temporary_folder() + "/none"), IoError);
        CHECK_THROWS_AS(signature_of(review.stored(), temporary_folder()), IoError);
    }
}

SCENARIO("Where signatures are required, only signed acceptances count", "[review][signature]") {
    if (!can_sign()) return;
    const SignedReview review;
    Session session = Session::open(review.project, options());
    const auto missing = [&](std::size_t reviewers) {
        return missing_acceptance(
            review_of(session.project(), session.log(),
                      signed_or_rejecting(entered_verdicts(session.project(), review.signers))),
            reviewers);
    };
    const auto enter = [&](const std::string& reviewer, Verdict verdict, const std::string& key) {
        const std::string file =
            save_verdicts(review.project, verdicts_on(session, reviewer, verdict));
        if (!key.empty()) sign(file, key);
        import_verdicts(session, file);
    };
    enter("B. Roth", Verdict::Accept, "");
    enter("C. Lang", Verdict::Accept, new_signing_key());
    CHECK(missing(1).size() == 3);
    import_verdicts(session, review.file);
    CHECK(missing(1).empty());
    THEN("no unsigned verdict takes a signed rejection back") {
        enter("A. Kern", Verdict::Reject, review.key);
        enter("A. Kern", Verdict::Unsure, "");
        enter("A. Kern", Verdict::Accept, "");
        CHECK_THAT(missing(1).at(0), Contains("rejected by A. Kern"));
    }
    THEN("no other key takes it back, whatever name it gives") {
        const std::string other = new_signing_key();
        const std::string both =
            allowed_signers(allowed_line(kKern, review.key) + allowed_line("eve", other));
        enter("A. Kern", Verdict::Reject, review.key);
        enter("A. Kern", Verdict::Accept, other);
        const auto entered = signed_or_rejecting(entered_verdicts(session.project(), both));
        const Review found = review_of(session.project(), session.log(), entered);
        CHECK(found.edits.at(0).verdicts.size() == 2);
        CHECK(found.edits.at(0).status == ReviewStatus::Disputed);
        CHECK(review_of(session).edits.at(0).status == ReviewStatus::Disputed);
    }
    THEN("another key of the same signer does") {
        const std::string other = new_signing_key();
        const std::string both =
            allowed_signers(allowed_line(kKern, review.key) + allowed_line(kKern, other));
        enter("A. Kern", Verdict::Reject, review.key);
        enter("A. Kern", Verdict::Accept, other);
        const auto entered = signed_or_rejecting(entered_verdicts(session.project(), both));
        const Review found = review_of(session.project(), session.log(), entered);
        CHECK(found.edits.at(0).verdicts.size() == 1);
        CHECK(missing_acceptance(found, 1).empty());
        CHECK_FALSE(missing_acceptance(found, 2).empty());
    }
    THEN("two keys under one name are one person") {
        const std::string other = new_signing_key();
        const std::string both =
            allowed_signers(allowed_line(kKern, review.key) + allowed_line("eve", other));
        enter("a. kern", Verdict::Accept, other);
        const auto entered = signed_or_rejecting(entered_verdicts(session.project(), both));
        const Review found = review_of(session.project(), session.log(), entered);
        CHECK_THAT(missing_acceptance(found, 2).at(0), Contains("accepted by 1 of 2"));
    }
    THEN("a key signs for one reviewer, whatever names it gives") {
        enter("D. Moser", Verdict::Accept, review.key);
        CHECK_THAT(missing(2).at(0), Contains("accepted by 1 of 2"));
    }
    THEN("a rejection counts although nobody signed it") {
        enter("B. Roth", Verdict::Reject, "");
        CHECK_THAT(missing(1).at(0), Contains("disputed"));
    }
}

SCENARIO("A signature lies beside the verdicts", "[review][signature][hostile]") {
    const std::string file = temporary_folder() + "/verdicts.json";
    write_file(file, "{}");
    CHECK(signature_beside(file).empty());
    const std::string head = "-----BEGIN SSH SIGNATURE-----\n";
    write_file(file + ".sig", head);
    CHECK(signature_beside(file) == head);
    write_file(file + ".sig", "signed: A. Kern");
    CHECK_THROWS_WITH(signature_beside(file), Contains("verdicts.json.sig is no SSH signature"));
    write_file(file + ".sig", head + std::string(kLargestSignature, 'A'));
    CHECK_THROWS_WITH(signature_beside(file), Contains("bytes"));
    std::filesystem::remove(file + ".sig");
    std::filesystem::create_directory(file + ".sig");
    CHECK_THROWS_AS(signature_beside(file), IoError);
}

SCENARIO("Signed verdicts are entered as they were signed", "[review][signature]") {
    if (!can_sign()) return;
    const SignedReview review;
    WHEN("nobody says whose keys are allowed") {
        CHECK(imported(review, "").state == SignatureState::Unverified);
        THEN("the signature is kept, said to be unverified, and can be verified later") {
            const Audit made = audited(review.project, "");
            CHECK(made.findings.empty());
            CHECK(says(made.unverified, "who signed 1 file of verdicts"));
            CHECK_FALSE(says(made.unverified, "nothing is signed"));
            CHECK(made.statement["reviewers"][0]["signatures"][0] == "signed, not verified");
            const Audit verified = audited(review.project, review.signers);
            CHECK(verified.findings.empty());
            CHECK(says(verified.verified, "signed by kern@clinic.example"));
            CHECK_FALSE(says(verified.unverified, "who signed"));
            CHECK_THAT(audit_html(verified), Contains("signed by kern@clinic.example"));
        }
        THEN("an audit with other keys finds it") {
            const Audit made =
                audited(review.project, allowed_signers(allowed_line("roth", new_signing_key())));
            REQUIRE(made.findings.size() == 1);
            CHECK(made.findings[0].code == "signature-invalid");
            CHECK_THAT(made.findings[0].words.at("reviewer"), Contains("A. Kern"));
        }
        THEN("the project keeps the bytes, and its record binds them") {
            const Session session = Session::open(review.project, options());
            REQUIRE(session.project().verdicts().size() == 1);
            CHECK(session.project().verdicts()[0].text == file_content(review.file));
            CHECK(session.project().verdicts()[0].signature == signature_beside(review.file));
            CHECK(session.project().check_record().findings.empty());
            Database(review.project, OpenMode::Write)
                .run("DELETE FROM meta WHERE name LIKE 'signature %'");
            const RecordCheck check = session.project().check_record();
            REQUIRE(check.findings.size() == 1);
            CHECK(check.findings[0].code == "record-row-missing");
        }
    }
    WHEN("signatures are required") {
        CHECK(imported(review, review.signers).signer == kKern);
        Session session = Session::open(review.project, options());
        const Review found = review_of(session.project(), session.log(),
                                       entered_verdicts(session.project(), review.signers));
        CHECK(found.edits.at(1).verdicts.at(0).signature.signer == kKern);
        CHECK_THAT(entry_words(session.project().check_record().entries.back()),
                   Contains("signed by kern@clinic.example"));
        THEN("they are entered once, with or without their signature") {
            CHECK(import_verdicts(session, review.file, review.signers).known);
            std::filesystem::remove(review.file + ".sig");
            CHECK(import_verdicts(session, review.file).known);
            CHECK(session.project().verdicts().size() == 1);
        }
    }
    WHEN("the signature is of other bytes, nothing is entered, whoever is allowed") {
        write_file(review.file, file_content(review.file) + " ");
        CHECK_THAT(import_error(review, ""), Contains("does not verify"));
        CHECK(Session::open(review.project, options()).project().verdicts().empty());
    }
    WHEN("the signature does not verify, nothing is entered") {
        sign(review.file, review.key, "git");
        CHECK_THAT(import_error(review, review.signers), Contains("does not verify"));
        std::filesystem::remove(review.file + ".sig");
        CHECK_THAT(import_error(review, review.signers), Contains("is not signed"));
        write_file(review.file + ".sig", "no signature");
        CHECK_THAT(import_error(review, ""), Contains("is no SSH signature"));
        CHECK(Session::open(review.project, options()).project().verdicts().empty());
    }
    WHEN("the same verdicts were entered without a signature, it is added") {
        std::filesystem::rename(review.file + ".sig", review.file + ".later");
        CHECK(imported(review, "").state == SignatureState::None);
        std::filesystem::rename(review.file + ".later", review.file + ".sig");
        CHECK(imported(review, review.signers).state == SignatureState::Verified);
        const Session session = Session::open(review.project, options());
        const Review found = review_of(session.project(), session.log(),
                                       entered_verdicts(session.project(), review.signers));
        CHECK(found.edits.at(0).verdicts.size() == 1);
        CHECK(found.edits.at(0).verdicts[0].signature.signer == kKern);
    }
}

SCENARIO("A lost key is retired by an entry of its own", "[review][signature]") {
    if (!can_sign()) return;
    const SignedReview review;
    Session session = Session::open(review.project, options());
    import_verdicts(session, review.file);
    const std::string key = key_fingerprint(signing_key(signature_beside(review.file)));
    CHECK_THAT(run_program("ssh-keygen", {"-l", "-f", review.key + ".pub"}).out, Contains(key));
    const auto entered = [&] { return entered_verdicts(session.project(), review.signers); };
    const auto keys = [&] { return signing_keys(entered(), retired_keys(session.project())); };
    REQUIRE(keys().size() == 1);
    CHECK(keys()[0].fingerprint == key);
    CHECK(keys()[0].reviewers == std::vector<std::string>{"A. Kern"});
    CHECK(keys()[0].principals == std::vector<std::string>{kKern});
    CHECK_FALSE(keys()[0].retired);
    retire_key(session, key, "lost on the way home");
    THEN("the record has it, and lists it") {
        const ChainEntry last = session.project().record_entries().back();
        CHECK(last.kind == "key-retired");
        CHECK(last.subject == key);
        CHECK(last.author == "Ada");
        CHECK_THAT(entry_words(last), Contains("lost on the way home"));
        REQUIRE(keys().at(0).retired);
        CHECK(keys()[0].retired->reason == "lost on the way home");
        CHECK(audited(review.project, review.signers).findings.empty());
    }
    THEN("what it signed before stays as it is") {
        CHECK(entered().at(0).signature.state == SignatureState::Verified);
    }
    THEN("what it signs from now on is refused") {
        const std::string file =
            save_verdicts(review.project, verdicts_on(session, "A. Kern", Verdict::Reject));
        sign(file, review.key);
        CHECK_THROWS_WITH(import_verdicts(session, file), Contains("retired on") &&
                                                              Contains("lost on the way home") &&
                                                              Contains("another key"));
        sign(file, new_signing_key());
        import_verdicts(session, file);
        CHECK(session.project().verdicts().size() == 2);
    }
    THEN("what is no key, or retired already, is refused") {
        CHECK_THROWS_AS(retire_key(session, "A. Kern", "lost"), UsageError);
        CHECK_THROWS_WITH(retire_key(session, key, "again"), Contains("retired already"));
    }
}
