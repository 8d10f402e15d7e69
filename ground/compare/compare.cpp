// Prints a line a topic and the first difference of each; the exit code is for scripts.
#include "ground/compare/compare.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "ground/compare/recording_difference.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::string first;
  std::string second;
  bool quiet = false;
};

int compare(const Arguments& arguments) {
  bool same = true;
  for (const TopicComparison& topic : compare_recordings(arguments.first, arguments.second)) {
    same = same && topic.first_difference.empty();
    if (arguments.quiet) continue;
    std::printf("%-14s %8llu %8llu  %s\n", topic.topic.c_str(),
                static_cast<unsigned long long>(topic.samples_a),
                static_cast<unsigned long long>(topic.samples_b),
                topic.first_difference.empty() ? "the same" : topic.first_difference.c_str());
    if (topic.different > 1)
      std::printf("%-14s %8s %8s  %llu samples differ in all\n", "", "", "",
                  static_cast<unsigned long long>(topic.different));
  }
  if (!arguments.quiet) std::puts(same ? "the recordings are the same" : "the recordings differ");
  return same ? 0 : 1;
}

}  // namespace

void add_compare(CLI::App& app, CommandContext& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Two recordings topic by topic; exit code 0 the same, 1 different, 2 not readable");
  command->add_option("first", arguments->first, "MCAP file")->required();
  command->add_option("second", arguments->second, "MCAP file")->required();
  command->add_flag("--quiet", arguments->quiet, "print nothing");
  command->callback([arguments, &context] { context.exit_code = compare(*arguments); });
}

}  // namespace omma::ground
