#include "workbench/window/shell/key_layout.h"

#include <catch2/catch.hpp>

#include "workbench/window/keys/keys.h"

using namespace vesselbench;

namespace {

/// A layout that differs from the US one in some keys.
KeyNames layout(std::map<int, std::string> differing) {
    return [differing = std::move(differing)](int position) {
        const auto found = differing.find(position);
        if (found != differing.end()) return found->second;
        if (position >= 'A' && position <= 'Z') return std::string(1, char(position - 'A' + 'a'));
        return std::string(1, char(position));
    };
}

const KeyNames kGerman =
    layout({{'Y', "z"}, {'Z', "y"}, {'[', "ü"}, {']', "+"}, {'-', "ß"}, {'/', "-"}});

/// Other letters on all keys.
const KeyNames kRussian = [](int position) {
    return position == '/' ? std::string(".") : std::string("я");
};

}  // namespace

SCENARIO("Shortcuts follow the letters on the keys", "[window][keys]") {
    CHECK(key_by_layout('Z', layout({})) == 'Z');
    GIVEN("a German keyboard") {
        CHECK(key_by_layout('Y', kGerman) == 'Z');
        CHECK(key_by_layout('Z', kGerman) == 'Y');
        CHECK(key_by_layout('A', kGerman) == 'A');
        THEN("keys that a US keyboard does not have keep their place") {
            CHECK(key_by_layout('[', kGerman) == keys::kLeftBracket);
            CHECK(key_by_layout(']', kGerman) == keys::kRightBracket);
        }
    }
    GIVEN("a French keyboard, with digits above Shift") {
        const KeyNames french = layout({{'Q', "a"}, {'A', "q"}, {'1', "&"}, {'7', "è"}});
        CHECK(key_by_layout('Q', french) == 'A');
        CHECK(key_by_layout('1', french) == '1');
        CHECK(key_by_layout('7', french) == '7');
    }
    GIVEN("a layout that has brackets elsewhere") {
        const KeyNames dvorak = layout({{'-', "["}, {'=', "]"}, {'[', "/"}, {'Q', "'"}});
        CHECK(key_by_layout('-', dvorak) == keys::kLeftBracket);
        CHECK(key_by_layout('=', dvorak) == keys::kRightBracket);
        CHECK(key_by_layout('Q', dvorak) == '\'');
    }
    GIVEN("a layout without Latin letters") {
        CHECK(key_by_layout('Z', kRussian) == 'Z');
        CHECK(key_by_layout('/', kRussian) == '/');
    }
    GIVEN("keys without a character") {
        const KeyNames named = [](int) { return std::string("x"); };
        for (const int key : {keys::kEscape, keys::kSpace, keys::kF12, keys::kPad0, keys::kEnter})
            CHECK(key_by_layout(key, named) == key);
    }
}

SCENARIO("A key is released as it was pressed", "[window][keys]") {
    PressedKeys pressed;
    CHECK(pressed.press('Y', kGerman) == 'Z');
    CHECK(pressed.press('Y', layout({})) == 'Z');  // it repeats
    CHECK(pressed.release('Y') == 'Z');
    CHECK(pressed.press('Y', layout({})) == 'Y');
    CHECK(pressed.release('Y') == 'Y');
    CHECK(pressed.release('Q') == 'Q');
}
