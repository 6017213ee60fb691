#include "bbmc/application/console/tokens.h"

namespace towbench::bbmc {
namespace {

constexpr bool is_space(char c) noexcept {
  return c == ' ' || c == '\t';
}
constexpr bool is_printable(char c) noexcept {
  return c > ' ' && c <= '~';
}

// "--name=value" -> "--name", "value".
bool push_word(Tokens& tokens, std::string_view word) noexcept {
  const std::size_t equals = word.find('=');
  if (!word.starts_with("--") || equals == std::string_view::npos) {
    return tokens.push_back(word);
  }
  return tokens.push_back(word.substr(0, equals)) && tokens.push_back(word.substr(equals + 1));
}

}  // namespace

core::Result<Tokens> split_line(std::string_view line) noexcept {
  Tokens tokens;
  std::size_t at = 0;
  while (at < line.size()) {
    if (is_space(line[at])) {
      ++at;
      continue;
    }
    const std::size_t start = at;
    while (at < line.size() && is_printable(line[at])) {
      ++at;
    }
    // Neither space nor printable: nothing a command is made of.
    if (at == start || !push_word(tokens, line.substr(start, at - start))) {
      return core::failure(core::ErrorCode::kRequestBadArgument);
    }
  }
  return tokens;
}

}  // namespace towbench::bbmc
