#include "coupler/step/task_list.h"

#include <gtest/gtest.h>

namespace magfsi::coupler {
namespace {

// What has been called, in order.
struct Heard {
    bool wants_second = true;
    std::string calls{};
};

class Noted : public Output {
  public:
    Noted(Heard& heard, char name) : heard_(heard), name_(name) {}
    void begin() override { heard_.calls += {'b', name_, ' '}; }
    void end_step() override { heard_.calls += {'s', name_, ' '}; }
    void finish() override { heard_.calls += {'f', name_, ' '}; }

  private:
    Heard& heard_;
    char name_;
};

const OutputKind<Heard> kinds[] = {{"first", "write first",
                                    [](Heard& heard) -> std::unique_ptr<Output> {
                                        return std::make_unique<Noted>(heard, '1');
                                    }},
                                   {"second", "write second",
                                    [](Heard& heard) -> std::unique_ptr<Output> {
                                        if (!heard.wants_second) return nullptr;
                                        return std::make_unique<Noted>(heard, '2');
                                    }},
                                   {}};

class ListOfOutputs : public testing::Test {
  protected:
    void add() { outputs.add(kinds, heard, tasks); }

    Heard heard;
    TaskList tasks;
    Outputs outputs;
};

TEST_F(ListOfOutputs, act_in_the_order_of_their_list) {
    add();
    EXPECT_EQ(tasks.names(), "write first, write second");
    outputs.begin();
    tasks.run();
    outputs.finish();
    EXPECT_EQ(heard.calls, "b1 b2 s1 s2 f1 f2 ");
    EXPECT_EQ(outputs.probes(), nullptr);
}

TEST_F(ListOfOutputs, that_nobody_wants_have_no_task) {
    heard.wants_second = false;
    add();
    EXPECT_EQ(tasks.names(), "write first");
    outputs.begin();
    tasks.run();
    EXPECT_EQ(heard.calls, "b1 s1 ");
}

TEST_F(ListOfOutputs, that_the_build_lacks_are_refused_by_name) {
    add();
    EXPECT_NO_THROW(outputs.need(true, "second"));
    EXPECT_NO_THROW(outputs.need(false, "third"));
    try {
        outputs.need(true, "third");
        FAIL() << "third is not in the build";
    } catch (const std::invalid_argument& fault) {
        EXPECT_STREQ(fault.what(),
                     "third is asked for, and this program was built without it");
    }
}

}  // namespace
}  // namespace magfsi::coupler
