#pragma once

#include <string>

namespace vesselbench {

/// The public key that an SSH signature names as its signer's, by the SHA-256 of its bytes
/// (PROTOCOL.sshsig of OpenSSH): equal for two signatures by one key. Nothing is verified.
/// \param signature armored; empty: none
/// \return empty if it is no such signature
[[nodiscard]] std::string signing_key(const std::string& signature);

/// A signing_key() as `ssh-keygen -l` prints it: "SHA256:" and the digest in base64.
[[nodiscard]] std::string key_fingerprint(const std::string& key);

/// True of a text as key_fingerprint() writes it.
[[nodiscard]] bool is_key_fingerprint(const std::string& text);

}  // namespace vesselbench
