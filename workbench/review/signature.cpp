#include "workbench/review/signature.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>
#include <vector>

#include <unistd.h>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/regular_file.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/project/utc_time.h"
#include "workbench/worker/child_process.h"

namespace vesselbench {

namespace {

constexpr const char* kNamespace = "vesselbench-verdicts";
constexpr const char* kHead = "-----BEGIN SSH SIGNATURE-----";
constexpr std::chrono::seconds kLimit{20};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (!line.empty()) lines.push_back(line);
    return lines;
}

/// "2024-05-17T09:30:00Z" as ssh-keygen reads it: "20240517093000".
std::string digits_of(const std::string& time) {
    std::string digits;
    std::ranges::copy_if(time, std::back_inserter(digits),
                         [](unsigned char c) { return std::isdigit(c) != 0; });
    if (digits.size() != 14 || time.size() != 20)
        throw InvalidInput("the stored verdicts have no time: " + shortened(printable(time)));
    return digits;
}

/// Runs `ssh-keygen -Y` with what all its ways to verify need.
class Verifier {
public:
    Verifier(const StoredVerdicts& verdicts, const std::filesystem::path& signers,
             const Progress& progress)
        : text_(verdicts.text),
          signature_(memory_file("vesselbench-signature")),
          signers_(signers),
          time_(digits_of(verdicts.time.empty() ? utc_now() : verdicts.time)),
          progress_(progress) {
        write_all(signature_.number(), std::as_bytes(std::span(verdicts.signature)));
    }

    /// Who may sign with the key of the signature.
    [[nodiscard]] ProgramResult find_principals() const { return run({"find-principals"}, ""); }

    [[nodiscard]] ProgramResult verify(const std::string& principal) const {
        return run({"verify", "-I", principal, "-n", kNamespace}, text_);
    }

    /// Whether the signature is one of these bytes, by any key.
    [[nodiscard]] ProgramResult check_bytes() const {
        return run({"check-novalidate", "-n", kNamespace}, text_);
    }

    /// The program's first complaint, without folders.
    [[nodiscard]] std::string problem(const ProgramResult& result) const {
        const std::vector<std::string> lines = lines_of(result.err);
        std::string line = lines.empty() ? "ssh-keygen does not say why" : lines.front();
        const std::string path = signers_.string();
        if (const std::size_t at = line.find(path); !path.empty() && at != std::string::npos)
            line.replace(at, path.size(), bare_name(signers_));
        return shortened(printable(line));
    }

private:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& action,
                                    const std::string& input) const {
        std::vector<std::string> command = {"ssh-keygen", "-Y"};
        command.insert(command.end(), action.begin(), action.end());
        // ssh-keygen closes what it is given beside its input, output and errors.
        const std::string file =
            "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(signature_.number());
        command.insert(command.end(), {"-s", file});
        if (!signers_.empty())
            command.insert(command.end(), {"-f", signers_.string(), "-Overify-time=" + time_});
        try {
            return run_to_end(command, input, kLimit, progress_);
        } catch (const IoError& error) {
            throw IoError(
                "signatures are verified by ssh-keygen of OpenSSH's client (Debian: "
                "openssh-client): " +
                std::string(error.what()));
        }
    }

    const std::string& text_;
    Descriptor signature_;
    std::filesystem::path signers_;
    std::string time_;
    Progress progress_;
};

}  // namespace

std::string signature_words(const Signature& signature) {
    switch (signature.state) {
        case SignatureState::Unverified:
            return "signed, not verified";
        case SignatureState::Verified:
            return "signed by " + signature.signer;
        case SignatureState::Invalid:
            return "its signature does not verify (" + signature.problem + ")";
        case SignatureState::None:
            break;
    }
    return "not signed";
}

std::string signature_beside(const std::filesystem::path& verdicts) {
    std::filesystem::path file = verdicts;
    file += ".sig";
    if (!file_exists(file)) return "";
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && size > kLargestSignature)
        throw InvalidInput(bare_name(file) + " has " + std::to_string(size) +
                           " bytes; signatures of at most " + std::to_string(kLargestSignature) +
                           " are read");
    std::string signature = file_content(file);
    if (!signature.starts_with(kHead) || signature.size() > kLargestSignature)
        throw InvalidInput(bare_name(file) + " is no SSH signature, as 'ssh-keygen -Y sign -n " +
                           kNamespace + "' writes it");
    return signature;
}

Signature signature_of(const StoredVerdicts& verdicts, const std::filesystem::path& signers,
                       const Progress& progress) {
    const bool is_signed = !verdicts.signature.empty();
    if (signers.empty())
        return {.state = is_signed ? SignatureState::Unverified : SignatureState::None};
    static_cast<void>(file_content(signers));  // says what is wrong with it better than ssh-keygen
    if (!is_signed) return {};
    const Verifier verifier(verdicts, signers, progress);
    const ProgramResult found = verifier.find_principals();
    const std::vector<std::string> principals = lines_of(found.out);
    if (found.exit_code != 0 || principals.empty())
        return {.state = SignatureState::Invalid, .problem = verifier.problem(found)};
    std::vector<std::string> signers_of_it;  // a key may sign something else under another name
    std::string problem;
    for (const std::string& principal : principals) {
        const ProgramResult verified = verifier.verify(principal);
        if (verified.exit_code == 0)
            signers_of_it.push_back(principal);
        else
            problem = verifier.problem(verified);
    }
    if (signers_of_it.empty()) return {.state = SignatureState::Invalid, .problem = problem};
    return {.state = SignatureState::Verified,
            .signer = joined(signers_of_it),
            .principals = std::move(signers_of_it)};
}

Signature checked_signature(const StoredVerdicts& verdicts, const Progress& progress) {
    if (verdicts.signature.empty()) return {};
    const Verifier verifier(verdicts, {}, progress);
    const ProgramResult checked = verifier.check_bytes();
    if (checked.exit_code == 0) return {.state = SignatureState::Unverified};
    return {.state = SignatureState::Invalid, .problem = verifier.problem(checked)};
}

}  // namespace vesselbench
