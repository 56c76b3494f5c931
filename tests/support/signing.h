#pragma once

#include <string>

namespace vesselbench::test {

/// False where there is no ssh-keygen: the scenario counts as skipped.
[[nodiscard]] bool can_sign();

/// A new Ed25519 key without a passphrase, in a folder of its own. \return the private key's file
[[nodiscard]] std::string new_signing_key();

/// Signs a file as a reviewer does. \return the signature's file, which lies beside it
std::string sign(const std::string& file, const std::string& key,
                 const std::string& name_space = "vesselbench-verdicts");

/// A line of a file of allowed signers. \param options "valid-before=..." and others
[[nodiscard]] std::string allowed_line(const std::string& principal, const std::string& key,
                                       const std::string& options = "");

/// A file of allowed signers, in a folder of its own. \return its path
[[nodiscard]] std::string allowed_signers(const std::string& lines);

}  // namespace vesselbench::test
