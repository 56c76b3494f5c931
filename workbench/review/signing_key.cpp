#include "workbench/review/signing_key.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include <openssl/evp.h>

#include "workbench/project/content_hash.h"
#include "workbench/report/base64.h"

namespace vesselbench {

namespace {

constexpr std::string_view kBegin = "-----BEGIN SSH SIGNATURE-----";
constexpr std::string_view kEnd = "-----END SSH SIGNATURE-----";
constexpr std::string_view kMagic = "SSHSIG";
constexpr std::size_t kVersionBytes = 4;
constexpr std::string_view kFingerprint = "SHA256:";
constexpr std::size_t kFingerprintDigits = 43;  ///< of 32 bytes in base64 without its padding

/// The bytes between the armor's lines; empty if there are none.
std::string unarmored(const std::string& signature) {
    const std::size_t begin = signature.find(kBegin), end = signature.find(kEnd);
    if (begin == std::string::npos || end == std::string::npos) return "";
    std::string text;
    for (std::size_t i = begin + kBegin.size(); i < end; ++i)
        if (std::isspace(static_cast<unsigned char>(signature[i])) == 0) text += signature[i];
    std::string bytes(text.size() / 4 * 3 + 3, '\0');
    const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                     reinterpret_cast<const unsigned char*>(text.data()),
                                     static_cast<int>(text.size()));
    bytes.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return bytes;
}

/// A text after its length in four bytes, the first the highest; empty if it is cut off.
std::string_view sized_text_at(std::string_view bytes) {
    constexpr std::size_t kLength = 4;
    if (bytes.size() < kLength) return "";
    std::size_t length = 0;
    for (std::size_t i = 0; i < kLength; ++i)
        length = length << 8U | static_cast<unsigned char>(bytes[i]);
    return length > bytes.size() - kLength ? "" : bytes.substr(kLength, length);
}

}  // namespace

std::string signing_key(const std::string& signature) {
    const std::string bytes = unarmored(signature);
    if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + kVersionBytes) return "";
    const std::string_view key =
        sized_text_at(std::string_view(bytes).substr(kMagic.size() + kVersionBytes));
    return key.empty() ? "" : hash_of_text(key);
}

std::string key_fingerprint(const std::string& key) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < key.size(); i += 2)
        bytes += static_cast<char>(std::stoi(key.substr(i, 2), nullptr, 16));
    const std::string digits = base64(bytes);
    return std::string(kFingerprint) + digits.substr(0, digits.find('='));
}

bool is_key_fingerprint(const std::string& text) {
    return text.starts_with(kFingerprint) &&
           text.size() == kFingerprint.size() + kFingerprintDigits &&
           std::all_of(text.begin() + kFingerprint.size(), text.end(), [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '+' || c == '/';
           });
}

}  // namespace vesselbench
