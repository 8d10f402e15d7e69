#include "fsw/services/parameter_store.hpp"

#include <optional>
#include <sstream>
#include <system_error>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/parameter_file.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {
namespace {

constexpr int kSlots = 2;

/// "tracker.gate_chi2 = 20 (the mission says 16)", a sentence a value that is not the mission's.
void say_differences(const ParameterSet& set, std::span<const ParameterEntry> entries,
                     const std::string& file, std::vector<std::string>& sentences) {
  for (const ParameterEntry& entry : entries) {
    if (set.values[entry.id] == entry.initial) continue;
    std::ostringstream text;
    text << file << ": " << entry.name << " = " << set.values[entry.id] << " (the mission says "
         << entry.initial << ")";
    sentences.push_back(text.str());
  }
}

}  // namespace

ParameterStore::ParameterStore(std::filesystem::path folder, std::string spacecraft, Parameters& parameters,
                               DurableFile* files)
    : folder_(std::move(folder)),
      spacecraft_(std::move(spacecraft)),
      parameters_(parameters),
      files_(files == nullptr ? system_files_ : *files) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (!std::filesystem::is_directory(folder_))
    throw InputError(folder_.string(), 0, "parameters", "a folder, or a place for one",
                     error ? error.message() : "something else");
  parameters_.use_store();
}

std::filesystem::path ParameterStore::slot(int index) const {
  return folder_ / (index == 0 ? "parameters.a" : "parameters.b");
}

std::vector<std::string> ParameterStore::load() {
  std::vector<std::string> sentences;
  std::optional<ParameterSet> newest;
  int newest_slot = 1;  // the first save goes to the other
  for (int i = 0; i < kSlots; ++i) {
    if (!std::filesystem::exists(slot(i))) continue;
    try {
      const ParameterSet set =
          read_parameter_text(read_text(slot(i)), parameters_.entries(), spacecraft_, slot(i).string());
      if (newest && newest->number >= set.number) continue;
      newest = set;
      newest_slot = i;
    } catch (const InputError& error) {
      sentences.push_back(std::string(error.what()) + "; not used");
    }
  }
  next_slot_ = 1 - newest_slot;
  if (newest) {
    say_differences(*newest, parameters_.entries(), slot(newest_slot).string(), sentences);
    parameters_.start_from(*newest);
  }
  return sentences;
}

void ParameterStore::save_pending() {
  ParameterSet set;
  if (!parameters_.take_for_saving(set)) return;
  try {
    files_.replace(slot(next_slot_), parameter_file_text(set, parameters_.entries(), spacecraft_));
    next_slot_ = 1 - next_slot_;
    parameters_.saved(set.number, true);
  } catch (const std::exception& error) {
    failure_ = "parameter set " + std::to_string(set.number) + " is not saved: " + error.what();
    parameters_.saved(set.number, false);
  }
}

}  // namespace omma
