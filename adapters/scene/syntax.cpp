#include "adapters/scene/syntax.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

#include "adapters/scene/utf8.h"

namespace magfsi::scene {

namespace {

Origin at(const YAML::Mark& mark, const Origin& whole) {
    if (whole.line == 0 || mark.is_null()) return whole;
    return {whole.source, mark.line + 1, mark.column + 1};
}

class DocumentCounter : public YAML::EventHandler {
  public:
    explicit DocumentCounter(const Origin& whole) : whole_(whole) {}

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (++documents_ == 2)
            refuse(at(mark, whole_), "a second document", "one scene a file",
                   "remove the line \"---\"");
    }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
    void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
    void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  const std::string&) override {}
    void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {}
    void OnMapEnd() override {}

  private:
    Origin whole_;
    int documents_ = 0;
};

void check_encoding(const std::string& text, const Origin& whole) {
    const std::size_t fault = first_fault_in_utf8(text);
    if (fault == std::string::npos) return;
    const std::string_view before = std::string_view(text).substr(0, fault);
    Origin where = whole;
    if (whole.line != 0) {
        where.line = 1 + static_cast<int>(std::ranges::count(before, '\n'));
        where.column = static_cast<int>(fault - (before.rfind('\n') + 1)) + 1;
    }
    refuse(where,
           fmt::format("the byte 0x{:02X}", static_cast<unsigned char>(text[fault])),
           "text in UTF-8");
}

}  // namespace

void check_syntax(const std::string& text, const Origin& whole) {
    check_encoding(text, whole);
    DocumentCounter counter(whole);
    try {
        std::istringstream stream(text);
        YAML::Parser parser(stream);
        while (parser.HandleNextDocument(counter)) {
        }
    } catch (const YAML::Exception& error) {
        refuse(at(error.mark, whole), fmt::format("no valid YAML ({})", error.msg),
               "YAML: \"key: value\" with indentation by spaces");
    }
}

}  // namespace magfsi::scene
