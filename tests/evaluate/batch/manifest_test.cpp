#include "evaluate/batch/manifest.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "evaluate/batch/job_arguments.h"
#include "evaluate/batch/job_outputs.h"
#include "support/files.h"

using namespace duet;
using namespace duet::batch;
using namespace duet::test;

namespace {

using Texts = std::vector<std::string>;

const std::vector<RenderOption> kOptions{
    {"spp", OptionKind::single},        {"seed", OptionKind::single},
    {"strict", OptionKind::flag},       {"techniques", OptionKind::optional_value},
    {"define", OptionKind::repeatable}, {"path", OptionKind::repeatable}};

class Manifest {
 public:
  Manifest(const std::string& name, const std::string& text) {
    std::filesystem::create_directory(folder_.path("m"));
    path_ = folder_.write("m/" + name, text);
    jobs = read_manifest(path_, kOptions, diagnostics_);
  }
  /// The messages without the folder.
  std::string errors() const {
    std::string all;
    for (const Diagnostic& d : diagnostics_.all())
      all += d.to_string().substr(folder_.path("m/").size()) + "\n";
    return all;
  }
  std::string beside(const std::string& name) const { return folder_.path(name); }
  Texts arguments(size_t job) const { return job_arguments(jobs.at(job)); }

  std::vector<Job> jobs;

 private:
  TemporaryDirectory folder_;
  std::string path_;
  Diagnostics diagnostics_;
};

}  // namespace

TEST_CASE("rows and objects are jobs, with scenes beside the manifest") {
  const std::string csv =
      "scene,spp,define,strict,techniques,output,path\n"
      "a.xml,16,x=1;y=a b,true,raw,a.exr;a.png,\n"
      "../b.xml,,,false,true,,data\n"
      "/c.xml,,,,,,\n";
  const std::string jsonl =
      R"({"scene": "a.xml", "spp": 16, "define": ["x=1", "y=a b"], "strict": true, "techniques": "raw",
 "output": ["a.exr", "a.png"]})";
  const std::string two =
      "\n{\"scene\": \"../b.xml\", \"strict\": false, \"techniques\": true, \"path\": \"data\", "
      "\"spp\": null}\n"
      "  \r\n{\"scene\": \"/c.xml\", \"seed\": \"\"}\r\n";
  std::string one_line = jsonl;
  std::erase(one_line, '\n');
  for (const auto& [name, text] :
       {std::pair{"jobs.csv", csv}, std::pair{"jobs.jsonl", one_line + two}}) {
    const Manifest m(name, text);
    CAPTURE(m.errors());
    REQUIRE(m.errors().empty());
    REQUIRE(m.jobs.size() == 3);
    CHECK(m.jobs[0].outputs == Texts{"a.exr", "a.png"});
    const Texts first = m.arguments(0);
    CHECK(std::vector(first.begin(), first.begin() + 3) ==
          Texts{"render", "--output=a.exr", "--output=a.png"});
    for (const char* argument :
         {"--spp=16", "--define=x=1", "--define=y=a b", "--strict", "--techniques=raw"}) {
      CAPTURE(argument);
      CHECK(std::count(first.begin(), first.end(), argument) == 1);
    }
    CHECK(first.size() == 10);
    CHECK(first[8] == "--");
    CHECK(first[9] == m.beside("m/a.xml"));
    CHECK(m.arguments(1) ==
          Texts{"render", "--techniques", "--path=" + m.beside("m/data"), "--", m.beside("b.xml")});
    CHECK(m.arguments(2) == Texts{"render", "--", "/c.xml"});
  }
  const Manifest m("jobs.csv", csv);
  CHECK(m.jobs[2].where.line == 4);
}

TEST_CASE("all that is wrong with a .csv is said with its line") {
  const Manifest m("jobs.csv",
                   "scene,sp,spp,stats,spp,strict\n"
                   "a.xml,1,2,3\n"
                   ",,,,,\n"
                   "-,,,,,maybe\n"
                   "b.xml,,,,,,\n");
  CHECK(m.errors() ==
        "jobs.csv:1: error: a job has no \"sp\" (did you mean \"spp\"?); it has scene, output and "
        "the long options of duet render without dashes\n"
        "jobs.csv:1: error: a job cannot have \"stats\": duet batch gives this option itself\n"
        "jobs.csv:1: error: there are two columns \"spp\"\n"
        "jobs.csv:2: error: 4 fields for 6 columns\n"
        "jobs.csv:3: error: this job has no scene\n"
        "jobs.csv:4: error: \"-\": a job needs a scene file\n"
        "jobs.csv:4: error: \"strict\" is true or false, not \"maybe\"\n"
        "jobs.csv:5: error: 7 fields for 6 columns\n");
  CHECK(Manifest("a.csv", "spp\n3\n").errors() ==
        "a.csv:1: error: the first row has no column \"scene\"\n");
  CHECK(Manifest("a.csv", "").errors() == "a.csv: error: there are no jobs\n");
  CHECK(Manifest("a.csv", "scene\n").errors() == "a.csv: error: there are no jobs\n");
}

TEST_CASE("all that is wrong with a .jsonl is said with its place") {
  const Manifest m("jobs.jsonl",
                   "{\"scene\": \"a.xml\", \"spp\": 1, \"spp\": 2}\n"
                   "{\"scene\": \"a.xml\",\n"
                   "[\"a.xml\"]\n"
                   "{\"scene\": [\"a.xml\"]}\n"
                   "{\"spp\": 3}\n"
                   "{\"scene\": \"a.xml\", \"define\": {\"x\": 1}, \"sede\": 3}\n"
                   "{\"scene\": \"\xff\"}\n"
                   "{\"scene\": \"a.xml\", \"output\": [\"b\\u0000.exr\"]}\n");
  const std::string errors = m.errors();
  CAPTURE(errors);
  for (const char* part :
       {"jobs.jsonl:1: error: \"spp\" is there twice\n",
        "jobs.jsonl:2:18: error: this is no JSON: syntax error while parsing object key",
        "jobs.jsonl:3: error: a job is an object: {\"scene\": …}\n",
        "jobs.jsonl:4: error: \"scene\" is a text, a number, true or false\n",
        "jobs.jsonl:5: error: this job has no scene\n",
        "jobs.jsonl:6: error: \"define\" is a text, a number or a list of them\n",
        "jobs.jsonl:6: error: a job has no \"sede\" (did you mean \"seed\"?)",
        "jobs.jsonl:7:12: error: this is no JSON: ",
        "jobs.jsonl:8: error: \"output\" has a character of code 0: b\uFFFD.exr\n"}) {
    CAPTURE(part);
    CHECK(errors.find(part) != errors.npos);
  }
}

TEST_CASE("files that are no manifests are refused") {
  CHECK(Manifest("jobs.txt", "a.xml").errors() ==
        "jobs.txt: error: a list of jobs is a .csv or .jsonl file, or a folder with scenes\n");
  Diagnostics diagnostics;
  CHECK(read_manifest("/nowhere/jobs.csv", kOptions, diagnostics).empty());
  CHECK(diagnostics.all().at(0).to_string() ==
        "/nowhere/jobs.csv: error: it cannot be read: No such file or directory");
}

TEST_CASE("any text is read as jobs or refused") {
  std::minstd_rand random(7);
  const std::string parts[] = {"scene", "spp",  "define", "\"", "\"\"", ",", ";",
                               "\n",    "\r\n", "{",      "}",  "[",    "]", ":",
                               "true",  "1",    "a.xml",  "\\", "\xff", " "};
  size_t jobs = 0, refused = 0;
  const TemporaryDirectory folder;
  for (int i = 0; i < 2000; ++i) {
    const char* name = i % 2 == 0 ? "a.csv" : "a.jsonl";
    std::string text = i % 2 == 0 ? "scene,spp,define\n" : "{\"scene\": \"a.xml\"";
    for (size_t n = random() % 6; n > 0; --n) text += parts[random() % std::size(parts)];
    if (i % 3 == 0) text += "}";
    Diagnostics diagnostics;
    const std::vector<Job> read = read_manifest(folder.write(name, text), kOptions, diagnostics);
    jobs += !read.empty();
    refused += diagnostics.has_errors();
    CHECK((!read.empty() || diagnostics.has_errors()));
  }
  CHECK(jobs > 30);
  CHECK(refused > 100);
}

TEST_CASE("options for all jobs give way to a job's own, and lists have both") {
  std::vector<Job> jobs(2);
  jobs[0].options = {{"spp", {"4"}}, {"define", {"x=1"}}};
  add_to_all(jobs, {{"spp", {"16"}}, {"define", {"y=2"}}, {"strict", {}}}, kOptions);
  CHECK(jobs[0].value("spp") == "4");
  CHECK(jobs[0].find("define")->values == Texts{"y=2", "x=1"});
  CHECK(jobs[0].find("strict"));
  CHECK(jobs[1].value("spp") == "16");
  CHECK(jobs[1].find("define")->values == Texts{"y=2"});
}

TEST_CASE("two jobs with one output are an error with both places") {
  std::vector<Job> jobs(3);
  const auto file = std::make_shared<const std::string>("jobs.csv");
  for (size_t i = 0; i < 3; ++i) jobs[i].where = {file, int(i) + 2, 0};
  jobs[0].outputs = {"a.exr", "out/x.exr"};
  jobs[1].outputs = {"b.exr"};
  jobs[2].outputs = {"./out/../out/x.exr"};
  jobs[1].scene = "room.xml", jobs[1].options = {{"raw", {"{scene}.exr"}}};
  jobs[2].scene = "b.exr", jobs[2].options = {{"raw", {"./room.exr"}}};
  Diagnostics diagnostics;
  check_outputs_differ(jobs, diagnostics);
  REQUIRE(diagnostics.all().size() == 3);
  CHECK(diagnostics.all()[0].to_string() ==
        "jobs.csv:3: error: b.exr is read by another job, jobs.csv:4");
  CHECK(diagnostics.all()[2].to_string().starts_with("jobs.csv:4: error: ./room.exr is written"));
  CHECK(diagnostics.all()[1].to_string() ==
        "jobs.csv:4: error: ./out/../out/x.exr is written by two jobs, the other is jobs.csv:2; "
        "a template with {scene}, {folder} or the name of an option tells them apart");
}

TEST_CASE("the batch's own options stand before the job's") {
  Job job;
  job.scene = "-x.xml";
  job.options = {{"threads", {"7"}}, {"spp", {"4"}}};
  CHECK(render_arguments(job, 2, "s.json") ==
        Texts{"render", "--skip-existing", "--quiet", "--progress=none", "--threads=2",
              "--stats=s.json", "--checkpoint=60s", "--spp=4", "--", "-x.xml"});
  job.options.push_back({"checkpoint", {"5s"}});
  const Texts own = render_arguments(job, 2, "s.json");
  CHECK(std::count(own.begin(), own.end(), "--checkpoint=60s") == 0);
  CHECK(std::count(own.begin(), own.end(), "--checkpoint=5s") == 1);
  for (const char* option : {"stats", "progress", "quiet", "skip-existing"})
    CHECK(is_given_by_batch(option));
  CHECK(!is_given_by_batch("spp"));
}
