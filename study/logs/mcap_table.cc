#include "study/logs/mcap_table.h"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "study/logs/json_numbers.h"
#include "study/logs/mcap_records.h"

namespace towbench::study::logs {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// What one message says: the columns that it has, and its numbers.
struct Sample {
  std::uint16_t channel = 0;
  std::uint64_t time_ns = 0;
  std::vector<std::pair<std::size_t, double>> numbers;  // column, value
};

class MessageRows {
 public:
  // False when there is too much to go on.
  bool take(const McapMessage& message, const McapChannels& channels) {
    const McapChannel& channel = channels.at(message.channel);
    if (channel.encoding != "json") {
      left_out_.insert(fmt::format("{} ({})", channel.topic, channel.encoding));
      return true;
    }
    Sample sample{message.channel, message.log_time_ns, {}};
    const std::string topic =
        channel.topic.starts_with('/') ? channel.topic.substr(1) : channel.topic;
    const bool is_json = for_each_number(message.data, [&](const std::string& path, double value) {
      if (const auto column = column_of(topic, path); column < kMostColumns) {
        sample.numbers.emplace_back(column, value);
      }
    });
    if (!is_json) {
      left_out_.insert(channel.topic + " (a message that is no JSON)");
      return true;
    }
    topics_[message.channel] = channel.topic;
    samples_.push_back(std::move(sample));
    return samples_.size() <= 4 * kMostRows;
  }

  Table table(const std::string& file, Findings& findings) {
    Table table;
    table.names.emplace_back("log_time_s");
    table.names.insert(table.names.end(), names_.begin(), names_.end());
    table.columns.resize(table.names.size());
    std::stable_sort(samples_.begin(), samples_.end(),
                     [](const Sample& a, const Sample& b) { return a.time_ns < b.time_ns; });
    const auto base = busiest();
    std::vector<double> last(names_.size(), kNone);
    for (const Sample& sample : samples_) {
      for (const auto& [column, value] : sample.numbers) {
        last[column] = value;
      }
      if (sample.channel == base) {
        add_row(table, sample.time_ns - samples_.front().time_ns, last);
      }
    }
    tell(file, base, findings);
    return table;
  }

 private:
  std::size_t column_of(const std::string& topic, const std::string& path) {
    const std::string name = path.empty() ? topic : topic + "." + path;
    const auto [at, is_new] = column_.try_emplace(name, names_.size());
    if (is_new && names_.size() + 1 < kMostColumns) {
      names_.push_back(name);
    } else if (is_new) {
      at->second = kMostColumns;
    }
    return at->second;
  }

  // The channel with most messages.
  [[nodiscard]] std::uint16_t busiest() const {
    std::map<std::uint16_t, std::size_t> messages;
    for (const Sample& sample : samples_) {
      ++messages[sample.channel];
    }
    const auto most = std::max_element(messages.begin(), messages.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
    return most == messages.end() ? std::uint16_t{0} : most->first;
  }

  static void add_row(Table& table, std::uint64_t time_ns, const std::vector<double>& values) {
    table.columns.front().push_back(1e-9 * static_cast<double>(time_ns));
    for (std::size_t i = 0; i < values.size(); ++i) {
      table.columns[i + 1].push_back(values[i]);
    }
    table.line.push_back(static_cast<std::uint32_t>(table.line.size() + 1));
  }

  void tell(const std::string& file, std::uint16_t base, Findings& findings) const {
    if (topics_.size() > 1) {
      std::vector<std::string> others;
      for (const auto& [channel, topic] : topics_) {
        if (channel != base) {
          others.push_back(topic);
        }
      }
      findings.push_back({Finding::Kind::kNote, "topics_joined",
                          fmt::format("{}: a row is a message of {}; each number of {} stands at "
                                      "its last value so far",
                                      file, topics_.at(base), fmt::join(others, ", "))});
    }
    if (!left_out_.empty()) {
      findings.push_back({Finding::Kind::kNote, "mcap_left_out",
                          fmt::format("{}: only JSON messages are read; left out: {}", file,
                                      fmt::join(left_out_, ", "))});
    }
  }

  std::vector<Sample> samples_;
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> column_;
  std::map<std::uint16_t, std::string> topics_;
  std::set<std::string> left_out_;
};

}  // namespace

bool is_mcap(std::string_view first_bytes) noexcept {
  return first_bytes.starts_with(kMcapMagic);
}

Table read_mcap_table(const std::filesystem::path& path, Findings& findings) {
  MessageRows rows;
  bool too_long = false;
  const McapEnd end =
      read_mcap(path, [&](const McapMessage& message, const McapChannels& channels) {
        too_long = !rows.take(message, channels);
        return !too_long;
      });
  const std::string file = path.string();
  const auto tell = [&](Finding::Kind kind, const char* name, const std::string& what) {
    findings.push_back({kind, name, file + ": " + what});
  };
  Table table = rows.table(file, findings);
  if (!end.damage.empty()) {
    tell(Finding::Kind::kNote, "mcap_damaged", "read up to " + end.damage);
  } else if (!end.ends_whole && !too_long) {
    tell(Finding::Kind::kNote, "mcap_damaged", "its end is missing; read as far as it goes");
  }
  if (too_long || table.rows() > kMostRows) {
    tell(Finding::Kind::kFatal, "too_long",
         fmt::format("more than {} rows; cut it into runs of some minutes", kMostRows));
  } else if (table.rows() == 0) {
    tell(Finding::Kind::kFatal, "no_rows", "no JSON message with a number");
  } else if (table.names.size() < 3) {
    tell(Finding::Kind::kFatal, "header_unusable",
         "its messages hold fewer than two numbers; a log has time, position and input");
  }
  return table;
}

}  // namespace towbench::study::logs
