#include "ground/events/events.hpp"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "fsw/services/event_store.hpp"
#include "fsw/services/text_input.hpp"
#include "ground/uplink/spacecraft_dictionary.hpp"

namespace omma::ground {
namespace {

struct Arguments {
  std::string file;
  std::string dictionary;
  std::uint32_t run = 0;
  bool warnings = false;
};

int tell(const Arguments& arguments) {
  StoredEvents stored = read_event_store(arguments.file);
  std::optional<SpacecraftDictionary> known;
  if (!arguments.dictionary.empty()) known.emplace(read_text(arguments.dictionary), arguments.dictionary);
  std::erase_if(stored.events, [&](const StoredEvent& event) {
    return (arguments.run != 0 && event.run != arguments.run) ||
           (arguments.warnings && event.moment.record.severity < EventSeverity::kWarning);
  });
  const std::string text =
      stored_events_text(stored.events, known ? std::span<const EventDescriptor>(known->events())
                                              : std::span<const EventDescriptor>());
  std::fputs(text.c_str(), stdout);
  std::printf("%zu events, %zu damaged records\n", stored.events.size(), stored.damaged);
  return 0;
}

}  // namespace

void add_events(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand("events", "Events that a flight program's event store kept");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("file", arguments->file, "event store: what `omma-fsw --events FILE` keeps")
      ->required();
  command->add_option("--dictionary", arguments->dictionary,
                      "what `omma-fsw MISSION --dictionary` prints: gives the sentences; default: numbers");
  command->add_option("--run", arguments->run, "of this run of the program alone")
      ->check(CLI::PositiveNumber);
  command->add_flag("--warnings", arguments->warnings, "warnings and failures alone");
  command->callback([arguments, &context] { context.exit_code = tell(*arguments); });
}

}  // namespace omma::ground
