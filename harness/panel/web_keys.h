// Who may use the panel. Its address holds a ticket that opens the door once; what it is exchanged
// for stays with that browser as a cookie. So an address that is seen later, in a history or over a
// shoulder, opens nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace towbench::harness {

class WebKeys {
 public:
  // 128 random bits in hexadecimal; the ticket that holds at present.
  [[nodiscard]] const std::string& ticket() const noexcept { return ticket_; }

  // A new cookie when `ticket` is the one that holds, and another ticket from then on; else empty.
  [[nodiscard]] std::string exchange(std::string_view ticket);
  [[nodiscard]] bool knows(std::string_view cookie) const noexcept;

 private:
  [[nodiscard]] static std::string random_text();

  static constexpr std::size_t kMostBrowsers = 8;  // the oldest is forgotten

  std::string ticket_ = random_text();
  std::vector<std::string> cookies_;
};

}  // namespace towbench::harness
