#include "harness/panel/web_keys.h"

#include <algorithm>
#include <array>
#include <random>

#include <fmt/format.h>

namespace towbench::harness {
namespace {

// In a time that does not tell how many letters were right.
bool same(std::string_view a, std::string_view b) noexcept {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    difference |= static_cast<unsigned>(a[i] == b[i] ? 0 : 1);
  }
  return difference == 0;
}

}  // namespace

std::string WebKeys::random_text() {
  std::random_device source;  // the kernel's, in libstdc++
  std::string text;
  for (int i = 0; i < 4; ++i) {
    text += fmt::format("{:08x}", source());
  }
  return text;
}

std::string WebKeys::exchange(std::string_view ticket) {
  if (!same(ticket, ticket_)) {
    return {};
  }
  ticket_ = random_text();
  if (cookies_.size() == kMostBrowsers) {
    cookies_.erase(cookies_.begin());
  }
  return cookies_.emplace_back(random_text());
}

bool WebKeys::knows(std::string_view cookie) const noexcept {
  return std::any_of(cookies_.begin(), cookies_.end(),
                     [&](const auto& known) { return same(known, cookie); });
}

}  // namespace towbench::harness
