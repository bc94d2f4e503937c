#include "base/http_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

namespace duet {

namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kMostClients = 16, kMostRequestBytes = 8192;
/// How often the thread looks whether it should end.
constexpr int kMillisecondsBetweenLooks = 50;

const char* reason_of(int status) {
  constexpr std::pair<int, const char*> reasons[] = {{200, "OK"},
                                                     {204, "No Content"},
                                                     {400, "Bad Request"},
                                                     {403, "Forbidden"},
                                                     {404, "Not Found"},
                                                     {405, "Method Not Allowed"},
                                                     {431, "Request Header Fields Too Large"}};
  for (const auto& [number, text] : reasons)
    if (number == status) return text;
  return "";
}

std::string response(const HttpAnswer& a) {
  std::string text =
      fmt::format("HTTP/1.1 {} {}\r\nConnection: close\r\nCache-Control: no-store\r\n", a.status,
                  reason_of(a.status));
  if (a.status == 405) text += "Allow: GET\r\n";
  if (a.status != 204)
    text +=
        fmt::format("Content-Type: {}\r\nX-Content-Type-Options: nosniff\r\nContent-Length: {}\r\n",
                    a.type, a.body.size());
  return text + "\r\n" + a.body;
}

HttpAnswer refusal(int status) {
  return {status, HttpAnswer{}.type, fmt::format("{}\n", reason_of(status))};
}

/// The value of a header field; its name is in lower case.
std::optional<std::string> field(const std::string& request, const std::string& name) {
  for (size_t at = request.find("\r\n"); at != request.npos; at = request.find("\r\n", at)) {
    at += 2;
    const size_t end = request.find("\r\n", at), colon = request.find(':', at);
    if (colon >= end || colon - at != name.size()) continue;
    const bool is_same = std::equal(name.begin(), name.end(), request.begin() + ptrdiff_t(at),
                                    [](char a, char b) { return a == std::tolower(uint8_t(b)); });
    if (!is_same) continue;
    const size_t first = request.find_first_not_of(" \t", colon + 1);
    const size_t last = request.find_last_not_of(" \t", end - 1);
    return first <= last ? request.substr(first, last + 1 - first) : "";
  }
  return std::nullopt;
}

}  // namespace

struct HttpServer::Client {
  TcpClient connection;
  std::string request = {}, response = {};
  size_t sent = 0;
  Clock::time_point last = Clock::now();  ///< when something happened

  bool is_answered() const { return !response.empty(); }
};

HttpServer::HttpServer(uint16_t port, Handler handler)
    : handler_(std::move(handler)), server_(port, int(kMostClients)), thread_([this] { work(); }) {}

HttpServer::~HttpServer() {
  ends_ = true;
  thread_.join();
}

void HttpServer::work() {
  std::vector<Client> clients;
  std::vector<TcpServer::Wait> waits;
  while (!ends_) {
    waits.clear();
    for (const Client& c : clients) waits.push_back({&c.connection, c.is_answered()});
    const bool has_come = server_.wait(waits, kMillisecondsBetweenLooks);
    for (size_t i = clients.size(); i-- > 0;)
      if (waits[i].is_ready && !go_on(clients[i])) clients.erase(clients.begin() + ptrdiff_t(i));
    if (has_come) accept_client(clients);
  }
}

void HttpServer::accept_client(std::vector<Client>& clients) const {
  std::optional<TcpClient> connection = server_.accept();
  if (!connection) return;
  clients.push_back({std::move(*connection)});
  if (clients.size() <= kMostClients) return;
  clients.erase(std::min_element(clients.begin(), clients.end(),
                                 [](const Client& a, const Client& b) { return a.last < b.last; }));
}

bool HttpServer::go_on(Client& c) const {
  c.last = Clock::now();
  if (!c.is_answered()) return read_request(c);
  const auto n = c.connection.send(std::string_view(c.response).substr(c.sent));
  if (!n) return false;
  c.sent += *n;
  if (c.sent < c.response.size()) return true;
  c.connection.end_sending();
  return false;
}

bool HttpServer::read_request(Client& c) const {
  char block[4096];
  const auto n = c.connection.receive(block);
  if (!n) return false;
  c.request.append(block, *n);
  if (const size_t end = c.request.find("\r\n\r\n"); end != c.request.npos)
    c.response = answer(c.request.substr(0, end + 2));
  else if (c.request.size() > kMostRequestBytes)
    c.response = response(refusal(431));
  return true;
}

std::string HttpServer::answer(const std::string& request) const {
  const std::string line = request.substr(0, request.find("\r\n"));
  const size_t target = line.find(' '), version = line.rfind(' ');
  if (target == line.npos || version <= target + 1 || !line.substr(version).starts_with(" HTTP/1."))
    return response(refusal(400));
  if (line.substr(0, target) != "GET") return response(refusal(405));
  const std::optional<std::string> host = field(request, "host");
  if (!host) return response(refusal(400));
  if (*host != fmt::format("127.0.0.1:{}", port()) && *host != fmt::format("localhost:{}", port()))
    return response(refusal(403));
  return response(handler_(line.substr(target + 1, version - target - 1)));
}

}  // namespace duet
