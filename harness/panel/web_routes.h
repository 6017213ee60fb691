// What the panel answers to a request, apart from how it travels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "harness/panel/web_keys.h"

namespace towbench::harness {

struct WebRequest {
  std::string method;
  std::string target;  // "/?ticket=..."
  std::string host;
  std::string origin;  // empty when the browser sent none
  std::string cookie;  // the header as it came
};

struct WebAnswer {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body{};
  std::optional<std::filesystem::path> file{};  // instead of a body
  std::string cookie{};                         // Set-Cookie
  std::string location{};
};

class WebRoutes {
 public:
  // `runs`: the folder whose files may be seen. `hosts`: what a browser on this machine may call
  // the server, port included; others are a page elsewhere that wants to be taken for this one.
  // `controller`: as catalogue_json() takes it.
  WebRoutes(std::filesystem::path runs, std::vector<std::string> hosts, WebKeys& keys,
            std::string controller = {})
      : runs_(std::move(runs)),
        hosts_(std::move(hosts)),
        keys_(keys),
        controller_(std::move(controller)) {}

  [[nodiscard]] WebAnswer answer(const WebRequest& request);
  // A WebSocket to /live: none when it is welcome, else the refusal.
  [[nodiscard]] std::optional<WebAnswer> refuse_socket(const WebRequest& request) const;

 private:
  [[nodiscard]] std::optional<WebAnswer> refuse_unauthorized(const WebRequest& request) const;
  [[nodiscard]] WebAnswer page_or_asset(std::string_view path) const;
  [[nodiscard]] WebAnswer file_below_runs(std::string_view path) const;

  std::filesystem::path runs_;
  std::vector<std::string> hosts_;
  WebKeys& keys_;
  std::string controller_;
};

}  // namespace towbench::harness
