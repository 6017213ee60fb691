#include "harness/panel/web_routes.h"

#include <algorithm>
#include <array>

#include "harness/panel/panel_assets.h"
#include "harness/panel/panel_json.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCookieName = "towbench=";

WebAnswer refusal(unsigned status, std::string why) {
  return {.status = status, .body = std::move(why) + "\n"};
}

std::string_view cookie_in(std::string_view header) {
  const auto at = header.find(kCookieName);
  if (at == std::string_view::npos) {
    return {};
  }
  const auto value = header.substr(at + kCookieName.size());
  return value.substr(0, value.find(';'));
}

// Letters, digits, '.', '_' and '-', not beginning with '.': no way up, none to hidden files, and
// nothing that would have to be unescaped.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  });
}

std::optional<std::string_view> type_of(const fs::path& file) {
  struct Type {
    std::string_view extension;
    std::string_view name;
  };
  constexpr std::array<Type, 8> kTypes{{{".html", "text/html; charset=utf-8"},
                                        {".csv", "text/csv; charset=utf-8"},
                                        {".json", "application/json"},
                                        {".jsonl", "application/x-ndjson"},
                                        {".md", "text/markdown; charset=utf-8"},
                                        {".txt", "text/plain; charset=utf-8"},
                                        {".toml", "text/plain; charset=utf-8"},
                                        {".xml", "text/plain; charset=utf-8"}}};
  const auto extension = file.extension().string();
  const auto* const found = std::find_if(
      kTypes.begin(), kTypes.end(), [&](const Type& type) { return type.extension == extension; });
  return found == kTypes.end() ? std::nullopt : std::optional(found->name);
}

}  // namespace

std::optional<WebAnswer> WebRoutes::refuse_unauthorized(const WebRequest& request) const {
  if (std::find(hosts_.begin(), hosts_.end(), request.host) == hosts_.end()) {
    return refusal(421, "this panel does not answer to that name");
  }
  if (!request.origin.empty() && request.origin != "http://" + request.host) {
    return refusal(403, "a page from elsewhere may not use this panel");
  }
  if (!keys_.knows(cookie_in(request.cookie))) {
    return refusal(403,
                   "not let in: open the address that the panel printed last; each opens one "
                   "browser, once");
  }
  return std::nullopt;
}

std::optional<WebAnswer> WebRoutes::refuse_socket(const WebRequest& request) const {
  if (request.target != "/live") {
    return refusal(404, "no such socket");
  }
  if (request.origin.empty()) {
    return refusal(403, "a socket without origin");
  }
  return refuse_unauthorized(request);
}

WebAnswer WebRoutes::answer(const WebRequest& request) {
  if (request.method != "GET") {
    return refusal(405, "only GET");
  }
  constexpr std::string_view kTicket = "/?ticket=";
  if (std::string_view(request.target).starts_with(kTicket)) {
    if (std::find(hosts_.begin(), hosts_.end(), request.host) == hosts_.end()) {
      return refusal(421, "this panel does not answer to that name");
    }
    const auto cookie = keys_.exchange(std::string_view(request.target).substr(kTicket.size()));
    if (!cookie.empty()) {
      return {.status = 303,
              .cookie = std::string(kCookieName) + cookie + "; HttpOnly; SameSite=Strict; Path=/",
              .location = "/"};
    }
    // A ticket that was used in this browser: the cookie is what counts.
  }
  if (auto unauthorized = refuse_unauthorized(request)) {
    return *unauthorized;
  }
  const std::string_view target = request.target;
  const auto path = target.substr(0, target.find('?'));
  if (path == "/api/catalogue") {
    return {.type = "application/json", .body = catalogue_json(controller_)};
  }
  if (path == "/api/folders") {
    return {.type = "application/json", .body = folders_json(runs_)};
  }
  constexpr std::string_view kRuns = "/runs/";
  return path.starts_with(kRuns) ? file_below_runs(path.substr(kRuns.size())) : page_or_asset(path);
}

WebAnswer WebRoutes::page_or_asset(std::string_view path) const {
  if (path == "/") {
    return {.type = "text/html; charset=utf-8", .body = std::string(panel::page_asset().text)};
  }
  if (path == "/panel.js") {
    return {.type = "text/javascript; charset=utf-8",
            .body = std::string(panel::script_asset().text)};
  }
  if (path == "/report.css") {
    return {.type = "text/css; charset=utf-8", .body = std::string(report::style_asset().text)};
  }
  if (path == "/panel.css") {
    return {.type = "text/css; charset=utf-8", .body = std::string(panel::style_asset().text)};
  }
  return refusal(404, "no such page");
}

WebAnswer WebRoutes::file_below_runs(std::string_view path) const {
  auto file = runs_;
  for (std::size_t from = 0; from <= path.size();) {
    const auto end = std::min(path.find('/', from), path.size());
    const auto name = path.substr(from, end - from);
    if (!is_plain_name(name)) {
      return refusal(404, "no such file");
    }
    file /= name;
    from = end + 1;
  }
  std::error_code error;
  const auto type = type_of(file);
  // Through links too: a run folder may have been put there by somebody else.
  const auto real = fs::weakly_canonical(file, error);
  const auto root = fs::weakly_canonical(runs_, error);
  const auto inside = std::mismatch(root.begin(), root.end(), real.begin(), real.end());
  if (!type || error || inside.first != root.end() || !fs::is_regular_file(real, error)) {
    return refusal(404, "no such file");
  }
  return {.type = std::string(*type), .file = real};
}

}  // namespace towbench::harness
