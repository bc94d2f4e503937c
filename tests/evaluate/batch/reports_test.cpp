#include "evaluate/batch/reports.h"

#include <doctest/doctest.h>
#include <pugixml.hpp>

#include "evaluate/batch/csv.h"
#include "image/image_io.h"
#include "support/files.h"

using namespace duet;
using namespace duet::batch;
using namespace duet::test;

namespace {

/// A job for each status; the first has an image.
struct Example {
  Example() {
    const auto file = std::make_shared<const std::string>("jobs.csv");
    const JobStatus statuses[] = {JobStatus::rendered, JobStatus::kept, JobStatus::interrupted,
                                  JobStatus::failed, JobStatus::not_started};
    for (const JobStatus status : statuses) {
      Job job;
      job.where = {file, int(jobs.size()) + 2, 0};
      job.scene = "a, \"b\" & <c>.xml";
      job.outputs = {folder.path(fmt::format("out #{}.exr", jobs.size()))};
      jobs.push_back(job);
      JobResult result;
      result.status = status;
      results.push_back(result);
    }
    results[0].spp = 64;
    results[0].seconds = 1.25;
    results[0].error = 0.031;
    results[0].messages = {"a.xml:3: warning: <odd>"};
    results[3].reason = "no \"good\" \x01\xff";
    Image image(8, 4, {"R", "G", "B"});
    for (float& value : image.data) value = 0.5F;
    write_exr(jobs[0].outputs[0], image, {});
  }
  BatchOutcome outcome() const { return {name, jobs, results, command_line, 61}; }

  TemporaryDirectory folder;
  std::string name = "jobs.csv", command_line = "duet batch jobs.csv";
  std::vector<Job> jobs;
  std::vector<JobResult> results;
};

size_t count_of(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++n;
  return n;
}

}  // namespace

TEST_CASE("the summary counts every status") {
  const Example e;
  CHECK(outcome_summary(e.outcome()) ==
        "5 jobs in 1 min 1 s: 1 rendered, 1 kept, 1 failed, 1 interrupted, 1 not started");
  CHECK(result_text(e.results[0]) == "64 spp, 1.2 s, error 3.1 %, 1 warning");
  const std::string table = outcome_table(e.outcome());
  CHECK(count_of(table, "\n") == 6);
  CHECK(table.find("out #0.exr") != table.npos);
}

TEST_CASE("the CSV of a batch can be read again") {
  const Example e;
  Diagnostics diagnostics;
  const auto rows = read_csv(outcome_csv(e.outcome()), {}, diagnostics);
  CHECK(!diagnostics.has_errors());
  REQUIRE(rows.size() == 6);
  const auto field = [&](size_t job, const std::string& column) {
    const auto& names = rows[0].fields;
    return rows[job].fields.at(
        size_t(std::find(names.begin(), names.end(), column) - names.begin()));
  };
  for (const CsvRow& row : rows) CHECK(row.fields.size() == rows[0].fields.size());
  CHECK(field(1, "place") == "jobs.csv:2");
  CHECK(field(1, "scene") == "a, \"b\" & <c>.xml");
  CHECK(field(1, "status") == "rendered");
  CHECK(field(1, "spp") == "64");
  CHECK(field(1, "error") == "0.031");
  CHECK(field(1, "warnings") == "1");
  CHECK(field(4, "status") == "failed");
  CHECK(field(4, "message") == e.results[3].reason);
  CHECK(field(5, "status") == "not started");
}

TEST_CASE("the JUnit XML of a batch has a case for each job") {
  const Example e;
  pugi::xml_document document;
  REQUIRE(document.load_string(outcome_junit(e.outcome()).c_str()));
  const pugi::xml_node suite = document.child("testsuite");
  CHECK(suite.attribute("tests").as_int() == 5);
  CHECK(suite.attribute("failures").as_int() == 3);
  CHECK(suite.attribute("skipped").as_int() == 1);
  std::vector<pugi::xml_node> cases;
  for (const pugi::xml_node c : suite.children("testcase")) cases.push_back(c);
  REQUIRE(cases.size() == 5);
  CHECK(cases[0].attribute("classname").value() == std::string("a, \"b\" & <c>.xml"));
  CHECK(!cases[0].child("failure"));
  CHECK(!cases[0].child("skipped"));
  CHECK(cases[0].child_value("system-err") == std::string("a.xml:3: warning: <odd>\n"));
  CHECK(cases[1].child("skipped"));
  for (const size_t i : {2, 3, 4}) CHECK(cases[i].child("failure"));
  CHECK(cases[3].child("failure").attribute("message").value() ==
        std::string("no \"good\" \xef\xbf\xbd\xef\xbf\xbd"));
}

TEST_CASE("the page of a batch shows images that open the files") {
  const Example e;
  const std::string path = e.folder.path("report.html");
  {
    AtomicFile file(path);
    write_outcome_page(e.outcome(), file);
    file.commit();
  }
  const std::string page = read_file(path);
  CHECK(count_of(page, "<tr data-verdict=") == 5);
  CHECK(page.find("<a href=\"./out%20%230.exr\"><img alt=\"\" src=\"data:image/jpeg;base64,/9j/") !=
        page.npos);
  CHECK(count_of(page, "<img") == 1);
  CHECK(page.find("&lt;odd&gt;") != page.npos);
  CHECK(page.find("<c>") == page.npos);
  CHECK(page.ends_with("</html>\n"));
}
