// The options of a bench: declared where they are used, told by `omma-bench NAME --help`, refused where they
// are not known or out of range.
#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace omma {

/// Options of one bench on the command line. A bench adds them all, each bound to a variable that holds the
/// default, and reads them before it measures. What is added must live until read().
class Options {
 public:
  /// `arguments` as main has them, the bench's name first.
  Options(const char* bench, const char* what, int arguments, char** texts);
  ~Options();
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  /// A whole number, at least `least`.
  void add(const char* name, int& value, const char* what, int least = 1);
  /// A text: a file, a folder.
  void add(const char* name, std::string& value, const char* what);
  /// A choice that is made by being there.
  void add(const char* name, bool& value, const char* what);

  /// Puts what the command line says into the variables. Throws CLI::ParseError where it cannot (or where
  /// help is asked for), which run() takes.
  void read();

  /// Runs a bench; returns its exit code, 0 after help, 2 after bad input, told in one sentence.
  static int run(int (*bench)(Options&), Options& options);

 private:
  std::unique_ptr<CLI::App> app_;
  int arguments_;
  char** texts_;
};

}  // namespace omma
