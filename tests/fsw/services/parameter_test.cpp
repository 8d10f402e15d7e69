// Parameters: staged, committed at a beat, saved so that a power cut at any byte and between any two steps
// costs the last commit at most; a damaged file is refused with a reason, never half taken.
#include "fsw/services/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "fsw/kernel/input_error.hpp"
#include "fsw/kernel/memory_guard.hpp"
#include "fsw/kernel/real_time_scope.hpp"
#include "fsw/services/parameter_file.hpp"
#include "fsw/services/parameter_input.hpp"
#include "fsw/services/parameter_store.hpp"

namespace omma {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

inline constexpr ParameterDescriptor kGain{.id = 3,
                                           .name = "camera.gain",
                                           .text = "gain",
                                           .value = {.name = "value", .least = 0, .most = 8},
                                           .instances = 2};
inline constexpr ParameterDescriptor kCount{
    .id = 5,
    .name = "tracker.count",
    .text = "count",
    .value = {.name = "value", .type = ValueType::kInteger, .least = 1, .most = 9}};
inline constexpr ParameterDescriptor kSide{
    .id = 6,
    .name = "tracker.side",
    .text = "side",
    .value = {.name = "value", .type = ValueType::kChoice, .choices = "left|right"}};

static_assert(are_unique(std::array{kGain, kCount, kSide}) && are_apart(std::array{kGain, kCount, kSide}));
static_assert(are_well_formed(std::array{kGain, kCount, kSide}));
constexpr ParameterDescriptor with_id(ParameterDescriptor parameter, std::uint16_t id) {
  parameter.id = id;
  return parameter;
}
static_assert(!are_apart(std::array{kGain, with_id(kCount, 4)}), "the second instance of the first");
static_assert(!is_well_formed(with_id(kCount, 0)) &&
              !is_well_formed(with_id(kGain, limits::kParameterIds - 1)));

std::vector<ParameterEntry> entries() {
  std::vector<ParameterEntry> all;
  add_entries(all, kGain, {1, 2}, {"left", "right"});
  add_entries(all, kCount, {4});
  add_entries(all, kSide, {0});
  return all;
}

Command command(const CommandDescriptor& descriptor, double parameter = 0, double value = 0) {
  return {.opcode = descriptor.id,
          .argument_count = static_cast<std::uint8_t>(descriptor.argument_count()),
          .arguments = {parameter, value}};
}

class ParametersTest : public testing::Test {
 protected:
  CommandOutcome give(const CommandDescriptor& descriptor, double parameter = 0, double value = 0) {
    return parameters.receive(command(descriptor, parameter, value), {});
  }
  void step() { parameters.step({}); }

  Events events;
  Parameters parameters{entries(), events};
};

TEST_F(ParametersTest, ValuesTakeEffectTogetherAtTheBeatAfterTheirCommit) {
  ParameterInput user;
  user.bind(parameters.committed);
  EXPECT_TRUE(user.has_news());
  EXPECT_FALSE(user.has_news());
  EXPECT_EQ(user->value(kGain, 1), 2);
  give(kSetParameter, kGain.id + 1, 7.5);
  give(kSetParameter, kSide.id, 1);
  step();
  EXPECT_FALSE(user.has_news());
  EXPECT_EQ(parameters.state->staged, 2);
  give(kCommitParameters);
  step();
  EXPECT_TRUE(user.has_news());
  EXPECT_EQ(user->value(kGain, 0), 1);
  EXPECT_EQ(user->value(kGain, 1), 7.5);
  EXPECT_EQ(user->value(kSide), 1);
  EXPECT_EQ(parameters.state->set, 1U);
  EXPECT_EQ(parameters.state->staged, 0);
}

TEST_F(ParametersTest, DiscardedAndMissionValues) {
  give(kSetParameter, kCount.id, 9);
  give(kDiscardParameters);
  give(kCommitParameters);
  step();
  EXPECT_EQ(parameters.committed->value(kCount), 4);
  give(kSetParameter, kCount.id, 9);
  give(kCommitParameters);
  step();
  EXPECT_EQ(parameters.committed->value(kCount), 9);
  give(kMissionParameters);
  give(kCommitParameters);
  step();
  EXPECT_EQ(parameters.committed->value(kCount), 4);
}

TEST_F(ParametersTest, EachKindOfBadValueHasItsReasonAndIsNotStaged) {
  const auto reason = [&](double id, double value) { return give(kSetParameter, id, value).reason; };
  EXPECT_EQ(reason(7, 1), CommandReason::kArgumentRange) << "no such parameter";
  EXPECT_EQ(reason(60000, 1), CommandReason::kArgumentRange);
  EXPECT_EQ(reason(0, 1), CommandReason::kArgumentRange);
  EXPECT_EQ(reason(kGain.id, 8.001), CommandReason::kArgumentRange);
  EXPECT_EQ(reason(kGain.id, -0.001), CommandReason::kArgumentRange);
  EXPECT_EQ(reason(kCount.id, 2.5), CommandReason::kArgumentType);
  EXPECT_EQ(reason(kSide.id, 2), CommandReason::kArgumentRange);
  EXPECT_EQ(reason(kGain.id, std::nan("")), CommandReason::kArgumentType);
  step();
  EXPECT_EQ(parameters.state->staged, 0);
}

TEST_F(ParametersTest, StagesAndCommitsInARealTimeStepWithoutTouchingMemory) {
  if (!memory_guard::installed()) GTEST_SKIP() << "the sanitizers bring their own malloc";
  const std::uint64_t before = memory_guard::violations().total();
  {
    const RealTimeScope real_time;
    for (int i = 0; i < 10; ++i) {
      give(kSetParameter, kCount.id, 1 + i % 9);
      give(kCommitParameters);
      step();
    }
  }
  EXPECT_EQ(memory_guard::violations().total(), before);
  EXPECT_EQ(parameters.state->set, 10U);
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}
void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// Ends the power before a step of a save, or in the middle of writing.
class PowerCut final : public DurableFile {
 public:
  struct Cut {};  // no exception of the system: nothing after it is done

  void write(const std::filesystem::path& file, std::string_view bytes) override {
    if (before_step == 0) {
      DurableFile::write(file, bytes.substr(0, bytes_written));
      throw Cut{};
    }
    step("write");
    DurableFile::write(file, bytes);
  }
  void flush(const std::filesystem::path& file) override {
    step(std::filesystem::is_directory(file) ? "flush folder" : "flush file");
    DurableFile::flush(file);
  }
  void rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
    step("rename");
    DurableFile::rename(from, to);
  }

  int before_step = -1;  ///< −1: never; 0: in the middle of writing
  std::size_t bytes_written = 0;
  std::vector<std::string> steps;

 private:
  void step(const std::string& name) {
    if (before_step > 0 && static_cast<int>(steps.size()) == before_step) throw Cut{};
    steps.push_back(name);
  }
};

class ParameterStoreTest : public testing::Test {
 protected:
  ParameterStoreTest() { std::filesystem::remove_all(folder); }
  ~ParameterStoreTest() override { std::filesystem::remove_all(folder); }

  /// A run of the program: what is in force at its start, after which `values` are committed one by one.
  struct Run {
    ParameterSet at_start;
    std::vector<std::string> said;
  };
  Run run(const std::vector<double>& counts = {}, DurableFile* files = nullptr) const {
    Events events;
    Parameters parameters(entries(), events);
    ParameterStore store(folder, "demo", parameters, files);
    Run result;
    result.said = store.load();
    result.at_start = *parameters.committed;
    for (const double count : counts) {
      parameters.receive(command(kSetParameter, kCount.id, count), {});
      parameters.receive(command(kCommitParameters), {});
      parameters.step({});
      store.save_pending();
    }
    return result;
  }
  std::filesystem::path slot(const char* name) const { return folder / name; }

  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("omma_parameters_" + std::to_string(getpid()));
};

TEST_F(ParameterStoreTest, WhatWasCommittedIsThereAtTheNextStartAndSaid) {
  EXPECT_THAT(run({7, 8, 9}).said, IsEmpty());
  const Run next = run();
  EXPECT_EQ(next.at_start.value(kCount), 9);
  EXPECT_EQ(next.at_start.number, 3U);
  EXPECT_THAT(next.said, ElementsAre(HasSubstr("tracker.count = 9 (the mission says 4)")));
  EXPECT_EQ(run({5}).at_start.number, 3U);
  EXPECT_EQ(run().at_start.number, 4U);
}

TEST_F(ParameterStoreTest, ASaveIsWrittenFlushedRenamedAndFlushedInThisOrder) {
  PowerCut files;
  run({7}, &files);
  EXPECT_THAT(files.steps, ElementsAre("write", "flush file", "rename", "flush folder"));
}

TEST_F(ParameterStoreTest, APowerCutAtEveryByteAndBetweenAllStepsCostsTheLastCommitAtMost) {
  run({7, 8});
  const std::string whole = bytes_of(slot("parameters.b"));
  const auto cut = [&](PowerCut& files) {
    std::filesystem::remove_all(folder);
    run({7, 8});
    EXPECT_THROW(run({9}, &files), PowerCut::Cut);
    const double found = run().at_start.value(kCount);
    EXPECT_TRUE(found == 8 || found == 9) << found;
    EXPECT_EQ(run({6}).at_start.value(kCount), found) << "and it goes on from there";
    EXPECT_EQ(run().at_start.value(kCount), 6);
    return found;
  };
  for (std::size_t bytes = 0; bytes <= whole.size(); ++bytes) {
    PowerCut files;
    files.before_step = 0;
    files.bytes_written = bytes;
    EXPECT_EQ(cut(files), 8) << "after " << bytes << " bytes";
  }
  for (int step = 1; step <= 3; ++step) {
    PowerCut files;
    files.before_step = step;
    EXPECT_EQ(cut(files), step == 3 ? 9 : 8) << "before step " << step;
  }
}

// A disk that reorders, or a worn cell: the newest file itself is short or wrong, at any byte.
TEST_F(ParameterStoreTest, ANewestFileDamagedAtAnyByteFallsBackToTheOneBefore) {
  run({7, 8});
  const std::string whole = bytes_of(slot("parameters.b"));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << at % 8));
    for (const std::string& damaged : {whole.substr(0, at), flipped}) {
      write_bytes(slot("parameters.b"), damaged);
      const Run next = run();
      ASSERT_EQ(next.at_start.value(kCount), 7) << at;
      ASSERT_EQ(next.said.size(), 2U);
      ASSERT_THAT(next.said[0], HasSubstr("parameters.b"));
      ASSERT_THAT(next.said[0], HasSubstr("not used"));
    }
  }
}

TEST_F(ParameterStoreTest, TenThousandMutatedFilesAreRefusedWithAReasonOrAppliedExactly) {
  ParameterSet set;
  for (const ParameterEntry& entry : entries()) set.values[entry.id] = entry.initial;
  set.number = 12;
  set.values[kGain.id] = 0.1;
  set.values[kCount.id] = 9;
  const std::string whole = parameter_file_text(set, entries(), "demo");
  ASSERT_EQ(read_parameter_text(whole, entries(), "demo", "f").values, set.values);
  std::mt19937 random(5);
  int refused = 0;
  for (int i = 0; i < 10'000; ++i) {
    std::string bytes = whole;
    const unsigned changes = random() % 4;
    for (unsigned c = 0; c < changes; ++c) {
      const std::size_t at = random() % (bytes.size() + 1);
      switch (random() % 3) {
        case 0:
          if (at < bytes.size()) bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes.insert(at, 1, static_cast<char>(random()));
          break;
        default:
          bytes.resize(at);
      }
    }
    try {
      const ParameterSet read = read_parameter_text(bytes, entries(), "demo", "parameters.a");
      ASSERT_EQ(bytes, whole) << "what was changed must not be taken";
      ASSERT_EQ(read.values, set.values);
      ASSERT_EQ(read.number, set.number);
    } catch (const InputError& error) {
      ASSERT_NE(bytes, whole);
      ASSERT_THAT(error.what(), HasSubstr("parameters.a: checksum: expected "));
      ++refused;
    }
  }
  EXPECT_GT(refused, 6000);
}

// With a checksum that is right: a file of another program, or made by hand.
TEST_F(ParameterStoreTest, AFileThatIsWholeAndWrongIsRefusedAsAWhole) {
  const auto fault = [&](const std::function<void(std::vector<ParameterEntry>&)>& change,
                         const std::string& spacecraft = "demo") {
    std::vector<ParameterEntry> theirs = entries();
    change(theirs);
    ParameterSet set;
    set.number = 1;
    for (const ParameterEntry& entry : theirs) set.values[entry.id] = entry.initial + 1;
    try {
      read_parameter_text(parameter_file_text(set, theirs, spacecraft), entries(), "demo", "f");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(fault([](auto&) {}), "no error");
  EXPECT_THAT(fault([](auto&) {}, "other"),
              HasSubstr("f:2: spacecraft: expected \"spacecraft demo\", found"));
  EXPECT_THAT(fault([](auto& all) { all[2].name = "tracker.size"; }),
              HasSubstr("f:6: parameter: expected one that this program and its mission have, found"));
  EXPECT_THAT(fault([](auto& all) { all[2].initial = 20; }),
              HasSubstr("f:6: tracker.count: expected a whole number 1 to 9, found \"21\""));
}

/// Refuses as a full or read-only disk does.
class FullDisk final : public DurableFile {
 public:
  void write(const std::filesystem::path&, std::string_view) override {
    throw std::system_error(ENOSPC, std::generic_category(), "cannot write");
  }
};

TEST_F(ParameterStoreTest, ACommitThatCannotBeSavedFailsAndIsSaid) {
  Events events;
  Parameters parameters(entries(), events);
  FullDisk files;
  ParameterStore store(folder, "demo", parameters, &files);
  EXPECT_EQ(parameters.receive(command(kCommitParameters), {}).state, CommandOutcome::State::kUnderWay);
  parameters.step({});
  EXPECT_EQ(parameters.progress({}).state, CommandOutcome::State::kUnderWay);
  store.save_pending();
  EXPECT_EQ(parameters.progress({}).reason, CommandReason::kNotSaved);
  EXPECT_THAT(store.failure(), HasSubstr("parameter set 1 is not saved: cannot write: No space left"));
}

TEST_F(ParameterStoreTest, AFolderThatCannotBeMadeIsASentence) {
  write_bytes(folder, "a file");
  Events events;
  Parameters parameters(entries(), events);
  try {
    const ParameterStore store(folder, "demo", parameters);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("parameters: expected a folder, or a place for one"));
  }
}

}  // namespace
}  // namespace omma
