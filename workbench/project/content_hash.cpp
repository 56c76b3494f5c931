#include "workbench/project/content_hash.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include <openssl/evp.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/regular_file.h"

namespace vesselbench {

namespace {

constexpr std::size_t kDigestBytes = 32;

void add_text(ContentHash& hash, const std::string& text) {
    hash.add(std::as_bytes(std::span(text)));
}

std::string hash_of_regular_file(const std::filesystem::path& path) {
    refuse_special_file(path);
    std::ifstream file(path, std::ios::binary);
    if (!file) throw IoError("cannot read " + path.filename().string());
    ContentHash hash;
    std::vector<char> buffer(std::size_t{1} << 20);
    while (file) {
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        hash.add(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(file.gcount()))));
    }
    if (file.bad()) throw IoError("cannot read " + path.filename().string() + " to the end");
    return hash.hex();
}

}  // namespace

struct ContentHash::State {
    EVP_MD_CTX* context = EVP_MD_CTX_new();

    ~State() { EVP_MD_CTX_free(context); }
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {
    if (state_->context == nullptr ||
        EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) != 1)
        throw AlgorithmFailure("the system's libcrypto does not offer SHA-256");
}

ContentHash::~ContentHash() = default;

void ContentHash::add(std::span<const std::byte> bytes) {
    EVP_DigestUpdate(state_->context, bytes.data(), bytes.size());
}

std::string ContentHash::hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    EVP_DigestFinal_ex(state_->context, digest.data(), nullptr);
    std::string text;
    for (std::size_t i = 0; i < kDigestBytes; ++i) {
        text += "0123456789abcdef"[digest[i] >> 4];
        text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
}

std::string hash_of_text(std::string_view text) {
    ContentHash hash;
    hash.add(std::as_bytes(std::span(text)));
    return hash.hex();
}

std::string hash_of_file(const std::filesystem::path& path) {
    if (!std::filesystem::is_directory(path)) return hash_of_regular_file(path);
    std::vector<std::filesystem::path> files;
    std::error_code ignored;  // a link that leads to itself is no file
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
        if (entry.is_regular_file(ignored)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    ContentHash all;
    for (const auto& file : files) add_text(all, hash_of_regular_file(file));
    return all.hex();
}

}  // namespace vesselbench
