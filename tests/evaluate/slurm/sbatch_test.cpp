#include "evaluate/slurm/sbatch.h"

#include <doctest/doctest.h>

#include <limits>

using namespace duet::slurm;

TEST_CASE("Slurm's time limits are read as Slurm reads them") {
  const std::pair<const char*, double> limits[] = {
      {"90", 5400},
      {"2:30", 150},
      {"1:00:00", 3600},
      {"2-0", 172800},
      {"1-02", 93600},
      {"1-02:30", 95400},
      {"1-02:30:15", 95415},
      {"0", std::numeric_limits<double>::infinity()},
      {"UNLIMITED", std::numeric_limits<double>::infinity()},
      {"infinite", std::numeric_limits<double>::infinity()}};
  for (const auto& limit : limits) {
    CAPTURE(limit.first);
    CHECK(time_limit(limit.first).value_or(-1) == limit.second);
  }
  for (const char* text : {"", "10m", "1h", "1:2:3:4", "1:", ":1", "-1", "1-", "a", "1-2-3", "1.5",
                           "1-2:3:4:5", "1:-2", "99999999999"}) {
    CAPTURE(text);
    CHECK(!time_limit(text));
  }
}

TEST_CASE("further options are refused if they break the array") {
  for (const char* line : {"--mem=8G", "--account=lab --qos=long", "-A lab", "-c 4", "--dead"})
    CHECK(option_refusal(line).empty());
  for (const char* line : {"--array=1-3", "--array 1-3", "-a 1", "-a1-3", "--dependency=singleton",
                           "-d after:1", "--mem=8G --wrap=true", "mem=8G", "", "--mem=1\nrm"}) {
    CAPTURE(line);
    CHECK(!option_refusal(line).empty());
  }
}

TEST_CASE("a percent sign in a name stays one") {
  CHECK(output_pattern("50%/a%b") == "50%%/a%%b");
}

TEST_CASE("the number of a job is told from other text") {
  CHECK(submitted_job("123\n")->number == "123");
  CHECK(submitted_job("123")->cluster == "");
  CHECK(submitted_job("123;east\n")->number == "123");
  CHECK(submitted_job("123;east\n")->cluster == "east");
  for (const char* text : {"", "\n", "Submitted batch job 123\n", "12a", "1\n2\n", ";east", "-1"}) {
    CAPTURE(text);
    CHECK(!submitted_job(text));
  }
}
