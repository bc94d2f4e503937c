// Runs the tests, and prints for each that fails the command that repeats it alone.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace {

std::string program;

/// Adds that command to what the reporter prints.
class RepeatListener : public doctest::IReporter {
 public:
  explicit RepeatListener(const doctest::ContextOptions& options) : out_(*options.cout) {}
  void test_case_start(const doctest::TestCaseData& test) override { test_ = &test; }
  void test_case_end(const doctest::CurrentTestCaseStats& stats) override {
    if (stats.failure_flags == 0) return;
    // Commas separate filters, and quotes end the shell's word: '?' stands for any character.
    std::string name = test_->m_name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ',' || c == '\''; }, '?');
    out_ << "To repeat it alone: " << program << (test_->m_skip ? " --no-skip" : "")
         << " --test-case='" << name << "'\n\n";
  }
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  std::ostream& out_;
  const doctest::TestCaseData* test_ = nullptr;
};

REGISTER_LISTENER("repeat", 1, RepeatListener);

}  // namespace

int main(int argc, char** argv) {
  program = argv[0];
  doctest::Context context(argc, argv);
  return context.run();
}
