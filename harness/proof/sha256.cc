#include "harness/proof/sha256.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <new>
#include <span>
#include <system_error>
#include <vector>

#include <openssl/evp.h>
#include <openssl/hmac.h>

namespace towbench::harness {
namespace {

using Digest = std::array<unsigned char, EVP_MAX_MD_SIZE>;

std::string hex(std::span<const unsigned char> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    if (context_ == nullptr || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw std::bad_alloc();
    }
  }
  void add(std::string_view text) { EVP_DigestUpdate(context_.get(), text.data(), text.size()); }
  std::string finish() {
    Digest digest{};
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    return hex(std::span(digest).first(size));
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

FileDigest digest_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return {};
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return {};
  }
  constexpr std::size_t kBlock = 1U << 16U;
  std::vector<char> block(kBlock);
  FileDigest digest;
  Sha256 hash;
  while (stream.read(block.data(), kBlock) || stream.gcount() > 0) {
    const std::string_view part(block.data(), static_cast<std::size_t>(stream.gcount()));
    hash.add(part);
    digest.bytes += part.size();
    digest.lines += static_cast<std::uint64_t>(std::count(part.begin(), part.end(), '\n'));
  }
  if (stream.bad()) {
    return {};
  }
  digest.sha256 = hash.finish();
  return digest;
}

std::string sha256(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return hash.finish();
}

std::string hmac_sha256(std::string_view key, std::string_view text) {
  Digest digest{};
  unsigned size = 0;
  const std::vector<unsigned char> bytes(text.begin(), text.end());
  if (HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), bytes.data(), bytes.size(),
           digest.data(), &size) == nullptr) {
    throw std::bad_alloc();
  }
  return hex(std::span(digest).first(size));
}

}  // namespace towbench::harness
