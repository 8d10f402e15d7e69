// Prints a line a topic and the first difference of each; the exit code is for scripts.
#include "ground/compare/compare.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"
#include "ground/compare/recording_difference.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::string first;
  std::string second;
  bool quiet = false;
  std::vector<std::string> tolerances;
};

// "1e-6" for all numbers, "FIELD=0.01" for those whose name begins so.
Tolerance tolerance_of(const std::vector<std::string>& texts) {
  Tolerance tolerance;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const auto number = finite_number(equals == std::string::npos ? text : text.substr(equals + 1));
    if (!number || *number < 0 || equals == 0) {
      throw InputError("arguments", 0, "--tolerance", "a number, or FIELD=NUMBER, not below zero", text);
    }
    if (equals == std::string::npos) {
      tolerance.relative = *number;
    } else {
      tolerance.fields.emplace_back(text.substr(0, equals), *number);
    }
  }
  return tolerance;
}

void tell_tolerated(const TopicComparison& topic) {
  if (topic.tolerated > 0)
    std::printf("%-14s %8s %8s  %llu samples differ within the tolerance\n", "", "", "",
                static_cast<unsigned long long>(topic.tolerated));
  if (!topic.largest.empty()) std::printf("%-14s %8s %8s  largest: %s\n", "", "", "", topic.largest.c_str());
}

int compare(const Arguments& arguments) {
  bool same = true;
  const Tolerance tolerance = tolerance_of(arguments.tolerances);
  const bool tolerant = !arguments.tolerances.empty();
  for (const TopicComparison& topic :
       compare_recordings(arguments.first, arguments.second, tolerant ? &tolerance : nullptr)) {
    same = same && topic.first_difference.empty();
    if (arguments.quiet) continue;
    std::printf(
        "%-14s %8llu %8llu  %s\n", topic.topic.c_str(), static_cast<unsigned long long>(topic.samples_a),
        static_cast<unsigned long long>(topic.samples_b),
        topic.first_difference.empty() ? (topic.tolerated > 0 ? "the same within the tolerance" : "the same")
                                       : topic.first_difference.c_str());
    if (topic.different > 1)
      std::printf("%-14s %8s %8s  %llu samples differ in all\n", "", "", "",
                  static_cast<unsigned long long>(topic.different));
    tell_tolerated(topic);
  }
  const char* alike =
      tolerant ? "the recordings are the same within the tolerance" : "the recordings are the same";
  if (!arguments.quiet) std::puts(same ? alike : "the recordings differ");
  return same ? 0 : 1;
}

}  // namespace

void add_compare(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Two recordings topic by topic; exit code 0 the same, 1 different, 2 not readable");
  command->add_option("first", arguments->first, "MCAP file")->required();
  command->add_option("second", arguments->second, "MCAP file")->required();
  command->add_option(
      "--tolerance", arguments->tolerances,
      "Numbers may differ: N, a part of their field's largest magnitude, or FIELD=N in its unit "
      "(attitude.chi2=0.1, dots.=0.01); may be given often");
  command->add_flag("--quiet", arguments->quiet, "print nothing");
  command->callback([arguments, &context] { context.exit_code = compare(*arguments); });
}

}  // namespace omma::ground
