// Everything that is set, one value a line, as it holds now: the same keys as in a controller file,
// because both come from the one visit() (OR-BBMC-2g).
#include <array>

#include "bbmc/application/reports/report.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

// 1.714e-5 kg m2 must not lose a digit.
constexpr int kDecimals = 12;

// Writes the value whose number is asked for, and no other.
class OneValue {
 public:
  OneValue(std::size_t wanted, TextWriter& out) noexcept : wanted_(wanted), out_(out) {}

  void value(std::string_view key, double field, core::Range /*range*/,
             std::string_view /*meaning*/) noexcept {
    if (is_wanted()) {
      begin(key).compact(field, kDecimals).end_line();
    }
  }
  void value(std::string_view key, bool field, core::Range /*range*/,
             std::string_view /*meaning*/) noexcept {
    if (is_wanted()) {
      begin(key).text(field ? "true" : "false").end_line();
    }
  }
  void value(std::string_view key, std::int64_t field, core::Range /*range*/,
             std::string_view /*meaning*/) noexcept {
    if (is_wanted()) {
      begin(key).integer(field).end_line();
    }
  }
  void value(std::string_view key, VelocityMethod field, core::Range /*range*/,
             std::string_view /*meaning*/) noexcept {
    if (is_wanted()) {
      begin(key).text(names_of(field)[static_cast<std::size_t>(field)]).end_line();
    }
  }
  template <typename Nested>
  void group(std::string_view key, Nested& nested, std::string_view /*meaning*/) noexcept {
    const std::size_t before = depth_;
    if (depth_ < path_.size()) {
      path_[depth_++] = key;
    }
    nested.visit(*this);
    depth_ = before;
  }

  [[nodiscard]] bool written() const noexcept { return written_; }

 private:
  [[nodiscard]] bool is_wanted() noexcept { return next_++ == wanted_; }
  TextWriter& begin(std::string_view key) noexcept {
    written_ = true;
    for (std::size_t i = 0; i < depth_; ++i) {
      out_.text(path_[i]).text(".");
    }
    return out_.text(key).text(" = ");
  }

  std::array<std::string_view, 6> path_{};
  std::size_t depth_ = 0;
  std::size_t next_ = 0;
  std::size_t wanted_;
  TextWriter& out_;
  bool written_ = false;
};

}  // namespace

bool ConfigReport::next(const SystemManager& system, TextWriter& out) noexcept {
  Configuration copy = system.configuration();  // visit() may write, and what holds must not change
  OneValue writer(value_, out);
  copy.visit(writer);
  ++value_;
  return writer.written();
}

}  // namespace towbench::bbmc
