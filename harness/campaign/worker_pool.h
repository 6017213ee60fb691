// Runs cases in processes of their own: several at once, and a case that ends its process is a
// result, not the end of the campaign.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "harness/campaign/campaign.h"

namespace towbench::harness {

// Calls `take` in this process with one line of JSON for each case, in the order in which they are
// done. Returns early when `stop` is set. Throws std::system_error when no process can be started.
void run_in_workers(const Campaign& campaign, std::span<const CampaignCase> cases,
                    std::size_t workers, const std::atomic<bool>& stop,
                    const std::function<void(const std::string&)>& take);

}  // namespace towbench::harness
