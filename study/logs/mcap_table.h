// An MCAP file of JSON messages as a table.
//
// A row is a message of the topic that has most of them, at its log time (column log_time_s, from
// the first message on). Its numbers are columns topic.field.sub, without the topic's first slash;
// true is 1. A number of another topic stands at its last value so far.
#pragma once

#include <filesystem>
#include <string_view>

#include "study/logs/finding.h"
#include "study/logs/table.h"

namespace towbench::study::logs {

[[nodiscard]] bool is_mcap(std::string_view first_bytes) noexcept;

// Fatal: mcap_unreadable, no_rows, too_long, header_unusable. Notes: mcap_damaged (read up to
// there), mcap_left_out (channels that are no JSON), topics_joined.
[[nodiscard]] Table read_mcap_table(const std::filesystem::path& path, Findings& findings);

}  // namespace towbench::study::logs
