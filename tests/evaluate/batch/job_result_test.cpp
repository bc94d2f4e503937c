#include "evaluate/batch/job_result.h"

#include <doctest/doctest.h>

#include <csignal>

#include "support/files.h"

using duet::ChildEnd;
using namespace duet::batch;
using namespace duet::test;

namespace {

ChildEnd exited(int code, const std::string& messages = "") {
  ChildEnd end;
  end.exit_code = code;
  end.messages = messages;
  return end;
}

ChildEnd killed(int signal) {
  ChildEnd end;
  end.signal = signal;
  return end;
}

JobStatus status_of(const ChildEnd& end, const std::string& statistics) {
  return result_of({}, end, statistics).status;
}

}  // namespace

TEST_CASE("how a process ends tells the status of its job") {
  const TemporaryDirectory folder;
  const std::string statistics =
      folder.write("s.json", R"({"integrator": "path", "spp": 64, "memory_peak_bytes": 1000,
      "error": {"relative_standard_error": 0.25, "is_upper_bound": true}})");
  const std::string none = folder.path("none.json");
  CHECK(status_of(exited(0), statistics) == JobStatus::rendered);
  CHECK(status_of(exited(0), none) == JobStatus::kept);
  CHECK(status_of(exited(1), statistics) == JobStatus::failed);
  CHECK(status_of(exited(4), statistics) == JobStatus::failed);
  for (const int code : {129, 130, 143})
    CHECK(status_of(exited(code), none) == JobStatus::interrupted);
  // The process may not have taken over the signal yet.
  CHECK(status_of(killed(SIGTERM), none) == JobStatus::interrupted);
  for (const int signal : {SIGSEGV, SIGKILL})
    CHECK(status_of(killed(signal), none) == JobStatus::failed);
  const JobResult r =
      result_of({}, exited(0, "duet: warning: odd\n\nx.xml:3: warning: \x1b\n"), statistics);
  CHECK(r.integrator == "path");
  CHECK(r.spp == 64);
  CHECK(r.error == 0.25);
  CHECK(r.error_is_bound);
  CHECK(r.memory_peak == 1000);
  CHECK(r.messages == std::vector<std::string>{"odd", "x.xml:3: warning: \xef\xbf\xbd"});
  CHECK(r.reason.empty());
}

TEST_CASE("a job that failed says why") {
  CHECK(result_of({}, killed(SIGKILL), "").reason == "killed by signal 9");
  CHECK(result_of({}, exited(3), "").reason == "exit code 3");
  CHECK(result_of({}, exited(1, "duet: warning: odd\nduet: error: bad\n"), "").reason == "bad");
  CHECK(result_of({}, exited(1, "x.xml:3:5: error: bad\nmore"), "").reason ==
        "x.xml:3:5: error: bad");
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "a line\n";
  const JobResult r = result_of({}, exited(1, many), "");
  CHECK(r.messages.size() < 60);
  CHECK(r.messages.back() == "(more messages are left out)");
}

TEST_CASE("a lack of memory is told from other failures") {
  CHECK(lacks_memory(killed(SIGKILL), true));
  CHECK(!lacks_memory(killed(SIGKILL), false));
  CHECK(!lacks_memory(killed(SIGSEGV), true));
  CHECK(lacks_memory(exited(1, "duet: error: out of memory\n"), false));
  CHECK(
      lacks_memory(exited(1, "the limit is 1 GB (environment variable DUET_MEMORY_LIMIT)"), false));
  CHECK(!lacks_memory(exited(1, "no such file"), true));
  CHECK(!lacks_memory(exited(0, "out of memory"), true));
}

TEST_CASE("the image that is shown is one that a browser opens, or what there is") {
  const TemporaryDirectory folder;
  Job job;
  job.outputs = {folder.write("a.exr", ""), folder.path("a.png")};
  JobResult r;
  r.status = JobStatus::rendered;
  CHECK(image_to_show(job, r) == job.outputs[0]);
  folder.write("a.png", "");
  CHECK(image_to_show(job, r) == job.outputs[1]);
  r.status = JobStatus::failed;
  CHECK(image_to_show(job, r).empty());
  r.status = JobStatus::interrupted;
  const std::string partial = folder.write("a.partial.png", "");
  CHECK(image_to_show(job, r) == partial);
}
