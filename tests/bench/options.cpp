#include "tests/bench/options.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <limits>

namespace omma {

Options::Options(const char* bench, const char* what, int arguments, char** texts)
    : app_(std::make_unique<CLI::App>(what, std::string("omma-bench ") + bench)),
      arguments_(arguments),
      texts_(texts) {
  app_->option_defaults()->always_capture_default();
}

Options::~Options() = default;

void Options::add(const char* name, int& value, const char* what, int least) {
  app_->add_option(name, value, what)
      ->check(CLI::Range(least, std::numeric_limits<int>::max()).description(""))
      ->type_name("N");
}

void Options::add(const char* name, std::string& value, const char* what) {
  app_->add_option(name, value, what);
}

void Options::add(const char* name, bool& value, const char* what) {
  app_->add_flag(name, value, what);
}

void Options::read() {
  app_->parse(arguments_, texts_);
}

int Options::run(int (*bench)(Options&), Options& options) {
  try {
    return bench(options);
  } catch (const CLI::ParseError& error) {
    return options.app_->exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", options.app_->get_name().c_str(), error.what());
    return 2;
  }
}

}  // namespace omma
