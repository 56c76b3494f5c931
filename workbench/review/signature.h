#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/project/stored_verdicts.h"

namespace vesselbench {

enum class SignatureState : std::uint8_t {
    None,        ///< there is no signature
    Unverified,  ///< nobody said whose keys are allowed
    Verified,    ///< by an allowed signer's key
    Invalid      ///< of other bytes, for another purpose, or by a key that is not allowed
};

/// What is known of who signed verdicts.
struct Signature {
    SignatureState state = SignatureState::None;
    std::string signer;  ///< verified: the principals of the key, as the allowed signers name them
    std::vector<std::string> principals;  ///< verified: each of them
    std::string problem;                  ///< invalid: why
};

/// "not signed"; "signed, not verified"; "signed by kern@clinic.example"; "its signature does not
/// verify (incorrect signature)"
[[nodiscard]] std::string signature_words(const Signature& signature);

/// The signature in the file beside a file of verdicts, of the same name with ".sig" behind it;
/// empty: there is none.
/// \throw InvalidInput if it is larger than kLargestSignature, or no SSH signature; IoError
[[nodiscard]] std::string signature_beside(const std::filesystem::path& verdicts);

/// Verifies a signature by OpenSSH's ssh-keygen in the namespace "vesselbench-verdicts". Keys have
/// to be valid when the verdicts were entered.
/// \param verdicts their time; empty: now
/// \param signers allowed signers (ssh-keygen(1), ALLOWED SIGNERS); empty: nothing is verified
/// \throw IoError if the allowed signers cannot be read, or there is no ssh-keygen;
/// AlgorithmFailure if ssh-keygen does not end; InvalidInput if the time is none
[[nodiscard]] Signature signature_of(const StoredVerdicts& verdicts,
                                     const std::filesystem::path& signers,
                                     const Progress& progress = {});

/// What is known of a signature without allowed signers: Unverified if it is one of these bytes,
/// for verdicts, by whatever key; else Invalid. \throw as signature_of()
[[nodiscard]] Signature checked_signature(const StoredVerdicts& verdicts,
                                          const Progress& progress = {});

}  // namespace vesselbench
