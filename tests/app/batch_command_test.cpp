// `duet batch`: the program as a user runs it, with real processes.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/workplace.h"
#include "evaluate/batch/csv.h"
#include "image/image_io.h"
#include "support/browser.h"
#include "support/show.h"
#include "support/source_path.h"

using namespace duet;
using namespace duet::test;

namespace {

using Texts = std::vector<std::string>;

/// Columns of --csv by name, without the first row.
Texts column(const Workplace& place, const std::string& file, const std::string& name) {
  Diagnostics diagnostics;
  const auto rows = batch::read_csv(read_file(place.path(file)), {}, diagnostics);
  Texts values;
  REQUIRE(!rows.empty());
  const auto& names = rows[0].fields;
  const auto at = size_t(std::find(names.begin(), names.end(), name) - names.begin());
  for (size_t i = 1; i < rows.size(); ++i) values.push_back(rows[i].fields.at(at));
  return values;
}

bool has_same_pixels(const Workplace& place, const std::string& a, const std::string& b) {
  const ImageFile one = read_image(place.path(a)), two = read_image(place.path(b));
  return one.image.data == two.image.data && one.bytes == two.bytes &&
         one.image.channels == two.image.channels;
}

/// The process that renders to a file, once it is ready for signals; 0 if there is none.
pid_t renderer_of(const std::string& output) {
  constexpr uint64_t kHandlesUsr1 = uint64_t(1) << (SIGUSR1 - 1);
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != name.npos) continue;
    const std::string line = read_file(entry.path() / "cmdline");
    if (!contains(line, "--output=" + output) || !contains(line, "--stats=")) continue;
    const std::string status = read_file(entry.path() / "status");
    const size_t caught = status.find("SigCgt:");
    if (caught == status.npos) continue;
    if (std::stoull(status.substr(caught + 7), nullptr, 16) & kHandlesUsr1) return std::stoi(name);
  }
  return 0;
}

/// Waits until the image so far of an endless render can be written.
pid_t wait_for_samples(const Workplace& place, const std::string& output) {
  pid_t id = 0;
  REQUIRE(Process::wait_until([&] { return (id = renderer_of(place.path(output))) != 0; }, 300));
  const std::string partial = output.substr(0, output.size() - 4) + ".partial.exr";
  kill(id, SIGUSR1);
  REQUIRE(Process::wait_until([&] { return place.has(partial); }, 300));
  std::filesystem::remove(place.path(partial));
  return id;
}

/// A manifest of endless jobs.
std::string endless_jobs(const Workplace& place, const Texts& outputs) {
  place.scene("endless.xml", endless_scene());
  std::string csv = "scene,output,time\n";
  for (const std::string& o : outputs) csv += "endless.xml," + place.path(o) + ",1h\n";
  return csv;
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("a batch renders what duet render does, and reports on all jobs") {
    const Workplace place;
    std::filesystem::create_directory(place.path("scenes"));
    std::filesystem::create_directory(place.path("tmp"));
    place.scene("scenes/a.xml");
    place.write("scenes/bad.xml", "<scene version=\"3.0.0\">\n  <shape type=\"spere\"/>\n</scene>");
    place.write("scenes/jobs.csv",
                "scene,output,spp,integrator\n"
                "a.xml,out/1.exr;out/1.png,4,\n"
                "a.xml,out/2.exr,8,bdpt\n"
                "bad.xml,,,\n"
                "a.xml,,16,\n");
    const ProcessOptions options{.directory = place.path(""),
                                 .environment = {{"TMPDIR", place.path("tmp")}}};
    const Texts call{"batch",    "scenes/jobs.csv", "-o",      "out/{scene}-{spp}-{seed}.exr",
                     "--csv",    "c.csv",           "--junit", "r/j.xml",
                     "--report", "r/report.html",   "--",      "--seed",
                     "5"};
    Outcome o = run_duet(call, options);
    CAPTURE(o.err);
    // bad.xml has no spp to be filled in.
    CHECK(o.code == 2);
    CHECK(contains(o.err,
                   "scenes/jobs.csv:4: error: -o out/{scene}-{spp}-{seed}.exr: only {scene}, "
                   "{folder} and {seed} are filled in; {{ means a brace"));
    CHECK(!place.has("out"));
    place.write("scenes/jobs.csv",
                "scene,output,spp,integrator\n"
                "a.xml,out/1.exr;out/1.png,4,\n"
                "a.xml,out/2.exr,8,bdpt\n"
                "bad.xml,,3,\n"
                "a.xml,,16,\n");
    o = run_duet(call, options);
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(column(place, "c.csv", "status") == Texts{"rendered", "rendered", "failed", "rendered"});
    CHECK(column(place, "c.csv", "spp") == Texts{"4", "8", "", "16"});
    CHECK(column(place, "c.csv", "place")[2] == "scenes/jobs.csv:4");
    CHECK(
        contains(column(place, "c.csv", "message")[2], "bad.xml:2:10: error: unknown shape type"));
    CHECK(contains(o.out, "4 jobs in "));
    CHECK(contains(o.out, ": 3 rendered, 1 failed\n"));
    CHECK(contains(o.err, "[4/4] "));
    CHECK(contains(read_file(place.path("r/j.xml")), "failures=\"1\""));
    CHECK(contains(read_file(place.path("r/report.html")), "href=\"./../out/1.png\"><img"));
    CHECK(std::filesystem::is_empty(place.path("tmp")));

    const Texts a{"scenes/a.xml", "--seed", "5"};
    const auto alone = [&](Texts more) {
      more.insert(more.begin(), a.begin(), a.end());
      REQUIRE(place.run(more).code == 0);
    };
    alone({"--spp", "4", "-o", "x1.exr", "-o", "x1.png"});
    alone({"--spp", "8", "-i", "bdpt", "-o", "x2.exr"});
    alone({"--spp", "16", "-o", "x3.exr"});
    CHECK(has_same_pixels(place, "out/1.exr", "x1.exr"));
    CHECK(has_same_pixels(place, "out/1.png", "x1.png"));
    CHECK(has_same_pixels(place, "out/2.exr", "x2.exr"));
    CHECK(has_same_pixels(place, "out/a-16-5.exr", "x3.exr"));

    // Again, with the scene repaired: nothing else is rendered.
    const std::string before = read_file(place.path("out/1.exr"));
    place.scene("scenes/bad.xml");
    o = run_duet(call, options);
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(column(place, "c.csv", "status") == Texts{"kept", "kept", "rendered", "kept"});
    CHECK(column(place, "c.csv", "spp") == Texts{"4", "8", "3", "16"});
    CHECK(column(place, "c.csv", "integrator")[1] == "bdpt");
    CHECK(read_file(place.path("out/1.exr")) == before);
    // A name alone does not make an image finished.
    place.write("out/2.exr", "mine");
    o = run_duet(call, options);
    CHECK(column(place, "c.csv", "status") == Texts{"kept", "rendered", "kept", "kept"});
    CHECK(has_same_pixels(place, "out/2.exr", "x2.exr"));
  }

  TEST_CASE("the report of a batch works in a browser") {
    const std::string program = browser();
    if (program.empty()) {
      MESSAGE("skipped: DUET_BROWSER is none");
      return;
    }
    const Workplace place;
    for (const char* folder : {"out", "r"}) std::filesystem::create_directory(place.path(folder));
    place.scene("a.xml");
    place.write("bad.xml", "<scene version='3.0.0'><shape type='spere'/></scene>");
    place.write("jobs.csv",
                "scene,output,spp\na.xml,out/with space & more.png,4\nbad.xml,out/b.png,\n"
                "a.xml,out/c.png,16\na.xml,out/d.png,8\n");
    REQUIRE(place.run({"batch", "jobs.csv", "--report", "r/report.html"}).code == 1);
    const DrivenPage page = drive_page(program, read_file(place.path("r/report.html")), R"(
      const errors = [];
      addEventListener("error", (e) => errors.push(e.message));
      const table = document.getElementById("jobs"), heads = [...table.tHead.rows[0].cells];
      const shown = () => [...table.tBodies[0].rows].filter((r) => r.offsetHeight > 0);
      const spp = () => shown().map((r) => r.cells[4].textContent);
      heads.find((h) => h.textContent === "spp").querySelector("button").click();
      const sorted = spp();
      [...document.querySelectorAll(".filter button")]
        .find((b) => b.textContent.startsWith("failed ")).click();
      const good = spp();
      const small = [...table.querySelectorAll("td img")].map((i) => i.naturalWidth);
      // What the small pictures open is an image.
      const large = [...table.querySelectorAll("td a")].map((a) => {
        const image = new Image();
        image.src = a.href;
        return image;
      });
      when(() => large.every((i) => i.complete),
           () => finish({sorted, good, small, large: large.map((i) => i.naturalWidth), errors}));
    )",
                                       place.path("r"));
    CAPTURE(page.console);
    CAPTURE(page.result);
    const auto r = nlohmann::json::parse(page.result);
    using List = nlohmann::json;
    CHECK(r["sorted"] == List{"4", "8", "16", "–"});
    CHECK(r["good"] == List{"4", "8", "16"});
    CHECK(r["small"] == List{16, 16, 16});
    CHECK(r["large"] == List{16, 16, 16});
    CHECK(r["errors"].empty());
    CHECK(page.console.empty());
  }

  TEST_CASE("what is wrong with a list is said together, and nothing is rendered") {
    const Workplace place;
    place.scene("a.xml");
    place.write("jobs.csv",
                "scene,output,spp,crop,nonsense\n"
                "a.xml,1.exr,x,,\n"
                "nowhere.xml,2.exr,,,\n"
                "a.xml,3.bmp,,\"1,2\",\n"
                "a.xml,1.exr\n"
                "a.xml,-,,,\n");
    const size_t files = place.count();
    const Outcome o = place.run({"batch", "jobs.csv"});
    CHECK(o.code == 2);
    CHECK(
        o.err ==
        "jobs.csv:1: error: a job has no \"nonsense\"; it has scene, output and the long options "
        "of duet render without dashes\n"
        "jobs.csv:2: error: --spp: \"x\" is not a whole number from 1 to 1073741824\n"
        "jobs.csv:3: error: cannot read nowhere.xml: No such file or directory\n"
        "jobs.csv:4: error: -o 3.bmp: images are written as .exr, .png or .jpg; the name of a new "
        "directory ends with /\n"
        "jobs.csv:4: error: --crop: \"1,2\" is not of the form x,y,w,h\n"
        "jobs.csv:5: error: 2 fields for 5 columns\n"
        "jobs.csv:6: error: -o -: standard output holds one image\n"
        "duet: error: jobs.csv: nothing is rendered\n");
    place.write("same.jsonl", "{\"scene\": \"a.xml\"}\n{\"scene\": \"a.xml\", \"seed\": 2}\n");
    const Outcome same = place.run({"batch", "same.jsonl"});
    CHECK(same.code == 2);
    CHECK(contains(same.err,
                   "same.jsonl:2: error: a.exr is written by two jobs, the other is same.jsonl:1"));
    CHECK(place.run({"batch", "same.jsonl", "-o", "{scene}{seed}.exr", "--", "--seed", "1", "-q"})
              .code == 2);
    const std::pair<Texts, const char*> wrong[] = {
        {{"batch"}, "jobs is required"},
        {{"batch", "nowhere"}, "nowhere: error: it cannot be read: No such file"},
        {{"batch", "a.xml"}, "a list of jobs is a .csv or .jsonl file"},
        {{"batch", "same.jsonl", "--spp", "3"}, "--spp"},
        {{"batch", "same.jsonl", "--", "more"}, "\"more\" is no option of duet render"},
        {{"batch", "same.jsonl", "--", "--stats=s"}, "duet batch gives this option"},
        {{"batch", "same.jsonl", "--", "-o", "x"}, "duet batch gives this option"},
        {{"batch", "same.jsonl", "--jobs", "0"}, "--jobs"},
        {{"batch", "same.jsonl", "-o", "{seed}.exr", "--", "--spp", "x"}, "--spp"},
        {{"batch", "same.jsonl", "-o", "/proc/nowhere/{spp}.exr", "--", "--spp", "3"}, "two jobs"},
    };
    for (const auto& [arguments, named] : wrong) {
      const Outcome refused = place.run(arguments);
      CAPTURE(refused.err);
      CHECK(refused.code == 2);
      CHECK(contains(refused.err, named));
    }
    CHECK(place.count() == files + 1);
  }

  TEST_CASE("options that no scene could have are found in all rows before the first job") {
    const Workplace place;
    place.scene("a.xml");
    const std::pair<const char*, const char*> wrong[] = {
        {R"("integrator": "pth")", "there is no integrator \"pth\" (did you mean \"path\"?)"},
        {R"("integrator": "path", "parameter": "max_dept=3")", "did you mean \"max_depth\"?"},
        {R"("integrator": "path", "parameter": "max_depth=x")", "parameter \"max_depth\" needs"},
        {R"("parameter": "max_depth")", "-I needs NAME=VALUE, not \"max_depth\""},
        {R"("integrator": "path", "techniques": true)", "\"path\" has no techniques"},
        {R"("integrator": "aov", "aov": "depth", "target-error": 0.1)",
         "no colours to estimate it from"},
        {R"("aov": "albdo")", "there is no layer \"albdo\" (did you mean \"albedo\"?)"},
        {R"("aov": "albedo", "output": "7.png")", "only .exr files can hold the other layers"},
        {R"("integrator": "aov", "aov": "depth", "output": "8.png")", "the image has layers only"},
        {R"("define": "x")", "-D needs NAME=VALUE, not \"x\""},
        {R"("size": "8x8", "crop": "0,0,9,1")",
         "--crop: the window reaches beyond the image of 8x8"},
        {R"("spp": 4, "slice": "1/5", "raw": "9.exr")", "4 samples per pixel have no 5 parts"},
        {R"("resume": "gone.exr")", "--resume: cannot read gone.exr: No such file"}};
    std::string list;
    int line = 0;
    for (const auto& [options, why] : wrong)
      list += fmt::format("{{\"scene\": \"a.xml\", \"seed\": {}, {}}}\n", ++line, options);
    // What only the scene can say is no mistake yet; of one row everything is said.
    list +=
        R"({"scene": "a.xml", "seed": 14, "parameter": "radius=1", "define": "x=1", "sensor": 7})";
    list +=
        "\n"
        R"({"scene": "a.xml", "seed": 15, "spp": "x", "size": 3, "format": "bmp", "tonemap": "y"})"
        "\n"
        R"({"scene": "a.xml", "seed": 16, "integrator": "bdpt", "techniques": true})";
    place.write("jobs.jsonl", list);
    const Outcome o = place.run({"batch", "jobs.jsonl", "-o", "{scene}-{seed}.exr"});
    CAPTURE(o.err);
    CHECK(o.code == 2);
    line = 0;
    for (const auto& [options, why] : wrong) {
      const std::string place_of_row = fmt::format("jobs.jsonl:{}: error: ", ++line);
      SHOW(why);
      const size_t at = o.err.find(place_of_row);
      REQUIRE(at != o.err.npos);
      CHECK(contains(o.err.substr(at, o.err.find('\n', at) - at), why));
    }
    CHECK(!contains(o.err, "jobs.jsonl:14"));
    CHECK(!contains(o.err, "jobs.jsonl:16"));
    for (const char* option : {"--spp: ", "--size: ", "--format: ", "--tonemap: "})
      CHECK(contains(o.err, std::string("jobs.jsonl:15: error: ") + option));
  }

  TEST_CASE("names are filled in once, whatever braces they have") {
    const Workplace place;
    place.scene("a{spp}.xml");
    place.write("jobs.csv",
                "scene,spp,output,define\n"
                "a{spp}.xml,1,{scene}-{spp}.exr,\n"
                "a{spp}.xml,1,b{{x}.exr,\n");
    const Outcome o = place.run({"batch", "jobs.csv"});
    CAPTURE(o.err);
    CAPTURE(o.out);
    CHECK(o.code == 0);
    CHECK(place.has("a{spp}-1.exr"));
    CHECK(place.has("b{x}.exr"));
    CHECK(contains(place.run({"batch", "jobs.csv"}).out, "2 kept"));
    CHECK(place.run({"a{spp}.xml", "--spp", "1", "-o", "{{{scene}}.exr"}).code == 0);
    CHECK(place.has("{a{spp}}.exr"));
  }

  TEST_CASE("files that cannot be written are named before anything is rendered") {
    const Workplace place;
    place.scene("a.xml");
    place.write("jobs.csv", "scene,output\na.xml,a.exr\na.xml,/proc/nowhere/b.exr\n");
    Outcome o = place.run({"batch", "jobs.csv"});
    CHECK(o.code == 2);
    CHECK(contains(o.err, "jobs.csv:3: error: cannot write /proc/nowhere/b.exr: the directory "));
    place.write("jobs.csv", "scene,output\na.xml,a.exr\n");
    for (const char* option : {"--csv", "--junit", "--report"}) {
      CAPTURE(option);
      CHECK(place.run({"batch", "jobs.csv", option, "/proc/nowhere/x"}).code == 2);
      CHECK(place.run({"batch", "jobs.csv", option, "."}).code == 2);
      for (const char* used : {"jobs.csv", "a.exr"}) {
        o = place.run({"batch", "jobs.csv", option, used});
        CHECK(o.code == 2);
        CHECK(contains(o.err, "has another use"));
      }
    }
    CHECK(read_file(place.path("jobs.csv")) == "scene,output\na.xml,a.exr\n");
    CHECK(place.count() == 2);
  }

  TEST_CASE("a disk that is full fails jobs and reports, and leaves nothing half-written") {
    const Workplace place;
    place.scene("a.xml");
    place.write("jobs.csv", "scene,output\na.xml,a.exr\na.xml,b.exr\n");
    place.write("old.html", "old");
    std::filesystem::create_directory(place.path("tmp"));
    const Outcome o = run_duet({"batch", "jobs.csv", "--csv", "c.csv", "--report", "old.html"},
                               {.directory = place.path(""),
                                .environment = {{"TMPDIR", place.path("tmp")}},
                                .file_limit = 1500});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "failed a.exr: a.xml: a.exr cannot be written"));
    CHECK(contains(o.err, "duet: error: --report: old.html cannot be written: "));
    CHECK(contains(o.out, "2 jobs in "));
    CHECK(column(place, "c.csv", "status") == Texts{"failed", "failed"});
    CHECK(read_file(place.path("old.html")) == "old");
    CHECK(place.count() == 5);
    CHECK(std::filesystem::is_empty(place.path("tmp")));
  }

  TEST_CASE("a process that is killed fails its job and no other") {
    const Workplace place;
    std::string jobs = endless_jobs(place, {"1.exr"});
    place.scene("a.xml");
    place.write("jobs.csv", jobs + "a.xml,2.exr,\n" + "a.xml,3.exr,\n");
    Process duet({"batch", "jobs.csv", "--csv", "c.csv", "-j", "1"}, {.directory = place.path("")});
    const pid_t id = wait_for_samples(place, "1.exr");
    // Keys of the terminal do not reach it twice.
    CHECK(getpgid(id) == id);
    kill(id, SIGKILL);
    const Outcome o = duet.wait(300);
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(column(place, "c.csv", "status") == Texts{"failed", "rendered", "rendered"});
    CHECK(column(place, "c.csv", "message")[0] == "killed by signal 9");
    CHECK(contains(o.err, "[1/3] failed " + place.path("1.exr") + ": killed by signal 9"));
    CHECK(place.has("3.exr"));
  }

  TEST_CASE("signals reach the processes, and the reports are written") {
    for (const int signal : {SIGINT, SIGTERM}) {
      const Workplace place;
      place.write("jobs.csv", endless_jobs(place, {"1.exr", "2.exr", "3.exr"}));
      Process duet({"batch", "jobs.csv", "--csv", "c.csv", "--report", "r.html", "-j", "2", "-t",
                    "2", "--progress", "bar"},
                   {.directory = place.path("")});
      for (const char* output : {"1.exr", "2.exr"}) wait_for_samples(place, output);
      duet.send(signal);
      const Outcome o = duet.wait(300);
      CAPTURE(o.err);
      CHECK(o.code == 128 + signal);
      CHECK(column(place, "c.csv", "status") == Texts{"interrupted", "interrupted", "not started"});
      CHECK(place.has("1.partial.exr"));
      CHECK(place.has("2.partial.exr"));
      CHECK(!place.has("1.exr"));
      CHECK(contains(read_file(place.path("r.html")), "href=\"./1.partial.exr\"><img"));
      CHECK(contains(o.err, "0 of 3 jobs, 2 running"));
      // Repeated, it goes on from the samples that there are: here more than asked for.
      CHECK(place.has("1.checkpoint.exr"));
      const std::string spp = column(place, "c.csv", "spp")[0];
      place.write("jobs.csv",
                  "scene,output,time\nendless.xml," + place.path("1.exr") + ",0.001s\n");
      CHECK(place.run({"batch", "jobs.csv", "--csv", "c.csv"}).code == 0);
      CHECK(column(place, "c.csv", "status") == Texts{"rendered"});
      CHECK(column(place, "c.csv", "spp") == Texts{spp});
      CHECK(!place.has("1.checkpoint.exr"));
    }
  }

  TEST_CASE("SIGUSR1 gets the images so far, and the jobs go on") {
    const Workplace place;
    place.write("jobs.csv", endless_jobs(place, {"1.exr", "2.exr"}));
    Process duet({"batch", "jobs.csv", "-j", "2", "-t", "2"}, {.directory = place.path("")});
    for (const char* output : {"1.exr", "2.exr"}) wait_for_samples(place, output);
    duet.send(SIGUSR1);
    for (const char* partial : {"1.partial.exr", "2.partial.exr"})
      CHECK(Process::wait_until([&] { return place.has(partial); }, 300));
    for (const char* output : {"1.exr", "2.exr"}) CHECK(renderer_of(place.path(output)) != 0);
    duet.send(SIGINT);
    CHECK(duet.wait(300).code == 130);
  }

  TEST_CASE("no process outlives its batch") {
    const Workplace place;
    place.write("jobs.csv", endless_jobs(place, {"1.exr"}));
    Process duet({"batch", "jobs.csv"}, {.directory = place.path("")});
    wait_for_samples(place, "1.exr");
    duet.send(SIGKILL);
    duet.wait(300);
    CHECK(Process::wait_until([&] { return renderer_of(place.path("1.exr")) == 0; }, 300));
    CHECK(place.has("1.partial.exr"));
  }

  TEST_CASE("jobs that have too little memory beside others are rendered alone") {
    const Workplace place;
    place.scene("a.xml");
    place.write("jobs.csv", "scene,output\na.xml,1.exr\na.xml,2.exr\n");
    const auto run = [&](double megabytes) {
      return run_duet({"batch", "jobs.csv", "--csv", "c.csv", "-t", "2", "-j", "2", "--", "--size",
                       "1000x1000", "--spp", "1"},
                      {.directory = place.path(""),
                       .environment = {{"DUET_MEMORY_LIMIT", fmt::format("{:.0f}e6", megabytes)}}});
    };
    const Outcome little = run(60);
    CHECK(little.code == 1);
    CHECK(column(place, "c.csv", "status") == Texts{"failed", "failed"});
    CHECK(contains(column(place, "c.csv", "message")[0], "DUET_MEMORY_LIMIT"));
    // Sanitizers take more: what an image needs, and what each process takes.
    const auto megabytes = [&](const std::string& before) {
      const size_t at = little.err.find(before);
      REQUIRE(at != std::string::npos);
      return std::stod(little.err.substr(at + before.size()));
    };
    const double image = megabytes("needs about "), in_use = megabytes("beside the ");
    const Outcome enough_for_one = run(image + 2.2 * in_use + 20);
    CAPTURE(enough_for_one.err);
    CHECK(enough_for_one.code == 0);
    CHECK(column(place, "c.csv", "status") == Texts{"rendered", "rendered"});
    CHECK(column(place, "c.csv", "threads") == Texts{"2", "2"});
    for (const char* name : {"1.exr", "2.exr"}) std::filesystem::remove(place.path(name));
    const Outcome enough_for_both = run(2.2 * (image + 2 * in_use) + 40);
    CHECK(enough_for_both.code == 0);
    CHECK(column(place, "c.csv", "threads") == Texts{"1", "1"});
  }

  TEST_CASE("small images get a thread each and large ones all") {
    const Workplace place;
    place.scene("a.xml");
    place.write("jobs.csv",
                "scene,output,size\n"
                "a.xml,1.exr,64x64\na.xml,2.exr,64x64\na.xml,3.exr,300x300\n");
    REQUIRE(place.run({"batch", "jobs.csv", "--csv", "c.csv", "-t", "2"}).code == 0);
    CHECK(column(place, "c.csv", "threads") == Texts{"1", "1", "2"});
  }

  TEST_CASE("a folder is the scenes in it, and a dry run prints their commands") {
    const Workplace place;
    std::filesystem::create_directories(place.path("scenes/room"));
    place.scene("scenes/room/scene.xml");
    place.scene("scenes/other.xml");
    const Outcome dry = place.run({"batch", "scenes", "-n", "-o", "out/", "--", "--spp", "1"});
    CHECK(dry.code == 0);
    CHECK(dry.out ==
          "duet render --output=out/other.exr --spp=1 -- scenes/other.xml\n"
          "duet render --output=out/room.exr --spp=1 -- scenes/room/scene.xml\n");
    CHECK(!place.has("out"));
    place.scene("scenes/room/other.xml");
    CHECK(place.run({"batch", "scenes", "-n"}).code == 2);
    const Outcome tree =
        place.run({"batch", "./scenes/", "-n", "-o", "out/{subfolder}/{scene}-{folder}.exr"});
    CHECK(tree.out ==
          "duet render --output=out/./other-scenes.exr -- ./scenes/other.xml\n"
          "duet render --output=out/room/other-room.exr -- ./scenes/room/other.xml\n"
          "duet render --output=out/room/room-room.exr -- ./scenes/room/scene.xml\n");
    std::filesystem::remove(place.path("scenes/room/other.xml"));
    const Outcome o = place.run({"batch", "scenes", "-q", "-o", "out/", "--", "--spp", "1"});
    CHECK(o.code == 0);
    CHECK(o.err.empty());
    CHECK(o.out.empty());
    CHECK(place.has("out/other.exr"));
    CHECK(place.has("out/room.exr"));
  }

  TEST_CASE("the examples are rendered") {
    const Workplace place;
    for (const char* name : {"jobs.csv", "jobs.jsonl"}) {
      const Outcome o =
          place.run({"batch", source_path("examples/") + name, "--report", "report.html"});
      CAPTURE(o.err);
      CHECK(o.code == 0);
    }
    CHECK(std::distance(std::filesystem::directory_iterator(place.path("images")), {}) == 9);
  }
}
