#include "study/logs/bounded_lines.h"

namespace towbench::study::logs {
namespace {

constexpr std::size_t kBlock = 1 << 20;

}  // namespace

BoundedLines::BoundedLines(const std::filesystem::path& path)
    : opened_(std::filesystem::is_regular_file(path)) {
  if (opened_) {
    file_.open(path, std::ios::binary);
    opened_ = file_.is_open();
  }
}

// Keeps what is not yet given and reads on behind it.
bool BoundedLines::refill() {
  block_.erase(0, at_);
  at_ = 0;
  const std::size_t kept = block_.size();
  block_.resize(kept + kBlock);
  file_.read(block_.data() + kept, kBlock);
  block_.resize(kept + static_cast<std::size_t>(file_.gcount()));
  return block_.size() > kept;
}

bool BoundedLines::next(std::string_view& line) {
  std::size_t end = block_.find('\n', at_);
  if (end == std::string::npos && refill()) {
    end = block_.find('\n');
  }
  const bool last = end == std::string::npos;
  line = std::string_view(block_).substr(at_, last ? std::string_view::npos : end - at_);
  if (too_long_ || (last && line.empty())) {
    return false;
  }
  ++number_;
  too_long_ = line.size() > kLongestLine;
  at_ = last ? block_.size() : end + 1;
  if (!line.empty() && line.back() == '\r') {
    line.remove_suffix(1);
  }
  return !too_long_;
}

}  // namespace towbench::study::logs
