// The outcome of a batch as a page.
#include <fmt/format.h>

#include <filesystem>

#include "base/printable.h"
#include "base/seconds_text.h"
#include "evaluate/batch/job_arguments.h"
#include "evaluate/batch/reports.h"
#include "evaluate/web/page.h"
#include "evaluate/web/thumbnail.h"

namespace duet::batch {

namespace fs = std::filesystem;

namespace {

constexpr int kLongestThumbnail = 96;

std::string html_text(const std::string& text) {
  return escape_markup(printable(text));
}

/// The class of a status's badge (page.css).
const char* badge_class(JobStatus status) {
  switch (status) {
    case JobStatus::rendered:
    case JobStatus::kept:
      return "pass";
    case JobStatus::failed:
      return "fail";
    default:
      return "noisy";
  }
}

/// A file as the page refers to it: relative to the page's folder, which may be moved together with
/// what is below.
std::string link_to(const std::string& file, const std::string& page) {
  std::error_code ignored;
  const fs::path folder = fs::absolute(page, ignored).parent_path();
  const fs::path path = fs::absolute(file, ignored);
  const std::string relative = path.lexically_relative(folder.lexically_normal()).string();
  constexpr const char* plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.~/";
  std::string url;
  // A colon in the first part would make that a scheme.
  for (const char c : "./" + relative)
    url += std::string_view(plain).find(c) != std::string_view::npos
               ? std::string(1, c)
               : fmt::format("%{:02X}", uint8_t(c));
  return url;
}

std::string picture(const Job& job, const JobResult& r, const std::string& page) {
  const std::string file = image_to_show(job, r);
  if (file.empty()) return "<td class=\"none\"></td>";
  const std::string data = thumbnail_uri(file, kLongestThumbnail);
  const std::string shown = data.empty() ? "open" : fmt::format("<img alt=\"\" src=\"{}\">", data);
  return fmt::format("<td><a href=\"{}\">{}</a></td>", link_to(file, page), shown);
}

/// A cell that is sorted by a number.
std::string number_cell(double value, const std::string& text) {
  if (text.empty()) return "<td class=\"none\">–</td>";
  return fmt::format("<td data-value=\"{:.9g}\">{}</td>", value, text);
}

std::string details(const Job& job, const JobResult& r) {
  std::string html = html_text(r.reason);
  // That the reason is all there is, is seen already.
  if (!r.messages.empty() && r.messages != std::vector{r.reason}) {
    html += fmt::format("<details><summary>{} message{}</summary><pre>", r.messages.size(),
                        r.messages.size() == 1 ? "" : "s");
    for (const std::string& message : r.messages) html += html_text(message) + "\n";
    html += "</pre></details>";
  }
  std::string options;
  for (const std::string& option : option_arguments(job)) options += " " + option;
  if (!options.empty())
    html += "<div class=\"soft\"><small>" + html_text(options) + "</small></div>";
  return html;
}

std::string row(const Job& job, const JobResult& r, size_t number, const std::string& page) {
  return fmt::format(
             "<tr data-verdict=\"{0}\"><td data-value=\"{1}\">{1}</td>{2}<td class=\"name\">{3}"
             "<div class=\"soft\"><small>{4}</small></div></td>"
             "<td class=\"text\"><span class=\"badge {5}\">{0}</span></td>",
             status_name(r.status), number, picture(job, r, page), html_text(job_name(job)),
             html_text(job.scene), badge_class(r.status)) +
         number_cell(r.spp, spp_text(r)) +
         number_cell(r.seconds, r.seconds > 0 ? seconds_text(r.seconds) : "") +
         number_cell(r.error.value_or(0), escape_markup(error_text(r))) +
         fmt::format("<td class=\"text\">{}</td></tr>\n", details(job, r));
}

}  // namespace

void write_outcome_page(const BatchOutcome& batch, AtomicFile& file) {
  file.write(web_page_start("duet batch " + printable(batch.name)));
  file.write(fmt::format(
      "<h1>{}</h1>\n<p class=\"soft\">{}.</p>\n"
      "<div class=\"bar filter\" data-table=\"jobs\"></div>\n<div class=\"card scroll\">"
      "<table class=\"sortable\" id=\"jobs\">\n<thead><tr><th>job</th><th>image</th>"
      "<th class=\"text\">name</th><th class=\"text\">status</th><th>spp</th><th>time</th>"
      "<th title=\"estimate of the relative standard error\">error</th>"
      "<th class=\"text\">messages and options</th></tr></thead>\n<tbody>\n",
      html_text(batch.name), html_text(outcome_summary(batch))));
  for (size_t i = 0; i < batch.jobs.size(); ++i)
    file.write(row(batch.jobs[i], batch.results[i], i + 1, file.path()));
  file.write(fmt::format("</tbody></table></div>\n<h2>How this was made</h2>\n<pre>{}</pre>\n",
                         html_text(batch.command_line)));
  file.write(web_page_end());
}

}  // namespace duet::batch
