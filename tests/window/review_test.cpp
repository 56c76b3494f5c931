#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/window/review_support.h"
#include "tests/window/window_support.h"
#include "workbench/review/review_page_bytes.h"
#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/features/review/review_words.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

const Message& last_message(OffscreenShell& shell) {
    return shell.app().place().document.messages().back();
}

}  // namespace

SCENARIO("Edits are judged in the review step", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    CHECK(review_words(*feature_of(*shell).review()) == "not reviewed");
    CHECK(status_of_edit(*shell, 2) == ReviewStatus::Open);
    CHECK_FALSE(shell->has("review.accept"));
    REQUIRE(click_in_panel(*shell, "review.edit.2"));
    CHECK_FALSE(shell->has("review.accept"));  // nobody knows who reviews
    say_who(*shell);
    WHEN("one is accepted") {
        click_and_wait(*shell, "review.accept");
        CHECK(status_of_edit(*shell, 2) == ReviewStatus::Accepted);
        CHECK(status_of_edit(*shell, 1) == ReviewStatus::Open);
        CHECK(last_message(*shell).text == "Accepted edit 2, Smooth");
        const GivenVerdict& given = feature_of(*shell).chosen()->verdicts.at(0);
        CHECK(given.reviewer == "A. Kern");
        CHECK(given.role == "radiologist");
        THEN("it is outdated once the edit is changed") {
            shell->app().place().document.change(2, {{"iterations", Value(std::int64_t{3})}});
            REQUIRE(wait_until_idle(*shell));
            REQUIRE(shell->settle(60s));
            CHECK(status_of_edit(*shell, 2) == ReviewStatus::Outdated);
            CHECK(shell->app().place().step() == Step::Review);
        }
        THEN("it is kept with the project, and the name with the settings") {
            const auto project = shell->app().place().document.project();
            shell->app().place().close();
            REQUIRE(shell->settle(60s));
            const Session session = Session::open(project, session_options());
            CHECK(review_of(session).edits[1].status == ReviewStatus::Accepted);
            CHECK(shell->app().place().settings.reviewer == "A. Kern");
            CHECK_FALSE(feature_of(*shell).review());
        }
    }
    WHEN("one is rejected") {
        THEN("that needs a reason") {
            CHECK_FALSE(click_in_panel(*shell, "review.reject"));
            feature_of(*shell).give(Verdict::Reject);
            REQUIRE(shell->fill_item("review.comment", "  "));
            CHECK_FALSE(click_in_panel(*shell, "review.reject"));
            CHECK(feature_of(*shell).why_not(Verdict::Reject) == "a rejection needs a reason");
            CHECK(status_of_edit(*shell, 2) == ReviewStatus::Open);
        }
        THEN("its form opens for the correction") {
            REQUIRE(shell->fill_item("review.comment", "too smooth"));
            click_and_wait(*shell, "review.reject");
            CHECK(status_of_edit(*shell, 2) == ReviewStatus::Rejected);
            CHECK(feature_of(*shell).draft().comment.empty());
            CHECK(remark_of(*feature_of(*shell).chosen()) == "A. Kern: too smooth");
            REQUIRE(click_in_panel(*shell, "review.correct"));
            REQUIRE(shell->app().place().form());
            CHECK(shell->app().place().form()->edit() == EditId{2});
            CHECK(shell->has("banner.review.action"));
            REQUIRE(shell->fill_item("field.iterations", "1"));
            click_and_wait(*shell, "operation.apply");
            const LogEntry& changed = shell->app().place().document.snapshot()->log[1];
            CHECK(changed.edit.edit.revision == 2);
            CHECK(changed.edit.note == "answers A. Kern: too smooth");
            REQUIRE(shell->click_item("rail.review"));
            REQUIRE(shell->settle(60s));
            CHECK(status_of_edit(*shell, 2) == ReviewStatus::Outdated);
        }
        THEN("leaving its form answers nothing") {
            REQUIRE(shell->fill_item("review.comment", "too smooth"));
            click_and_wait(*shell, "review.reject");
            REQUIRE(click_in_panel(*shell, "review.correct"));
            REQUIRE(shell->click_item("banner.review.action"));
            CHECK(shell->app().place().step() == Step::Review);
            shell->app().place().document.change(2, {{"iterations", Value(std::int64_t{3})}});
            REQUIRE(wait_until_idle(*shell));
            REQUIRE(shell->settle(60s));
            CHECK(shell->app().place().document.snapshot()->log[1].edit.note.empty());
        }
    }
    WHEN("the reviewer is unsure, the edit stays open") {
        click_and_wait(*shell, "review.unsure");
        CHECK(status_of_edit(*shell, 2) == ReviewStatus::Open);
        CHECK(feature_of(*shell).chosen()->verdicts.size() == 1);
    }
    WHEN("another person reviews") {
        click_and_wait(*shell, "review.accept");
        REQUIRE(click_in_panel(*shell, "review.who"));
        REQUIRE(shell->fill_item("review.name", "B. Roth"));
        REQUIRE(click_in_panel(*shell, "review.keep_name"));
        REQUIRE(shell->fill_item("review.comment", "too smooth"));
        click_and_wait(*shell, "review.reject");
        THEN("they may disagree") {
            CHECK(status_of_edit(*shell, 2) == ReviewStatus::Disputed);
            CHECK(remark_of(*feature_of(*shell).chosen()) == "B. Roth: too smooth");
        }
    }
}

SCENARIO("The review step names what to look at first", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    smooth_strongly(*shell);
    CHECK_FALSE(shell->has("review.queue.0"));
    click_and_wait(*shell, "review.find");
    CHECK_FALSE(shell->has("review.find"));
    REQUIRE(feature_of(*shell).queue());
    REQUIRE_FALSE(feature_of(*shell).queue()->empty());
    const QueueItem first = feature_of(*shell).queue()->front();
    CHECK(first.edit == 3);
    REQUIRE(click_in_panel(*shell, "review.queue.0"));
    CHECK(feature_of(*shell).chosen()->edit.id == 3);
    CHECK(shell->app().place().looked_at() == first.place);
    THEN("it is looked for again once an edit has changed") {
        shell->app().place().document.change(2, {{"iterations", Value(std::int64_t{3})}});
        REQUIRE(wait_until_idle(*shell));
        REQUIRE(shell->settle(60s));
        CHECK_FALSE(feature_of(*shell).queue());
        CHECK(shell->has("review.find"));
    }
}

SCENARIO("Verdicts are imported in the review step", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    import_roth(*shell);
    CHECK_THAT(last_message(*shell).text, Contains("2 verdicts of B. Roth"));
    CHECK(status_of_edit(*shell, 1) == ReviewStatus::Accepted);
    CHECK(status_of_edit(*shell, 2) == ReviewStatus::Rejected);
    THEN("their pins are in the view, and are looked at from the list") {
        CHECK(shell->has("view.pin.2.0"));
        REQUIRE(click_in_panel(*shell, "review.edit.2"));
        REQUIRE(click_in_panel(*shell, "review.pin.0"));
        CHECK(shell->app().place().looked_at() == Vec3(4, 0, 5));
    }
    THEN("pins are seen while the edit is corrected, and in no other step") {
        REQUIRE(click_in_panel(*shell, "review.edit.2"));
        REQUIRE(click_in_panel(*shell, "review.correct"));
        REQUIRE(shell->settle(60s));
        CHECK(shell->has("view.pin.2.0"));
        REQUIRE(shell->click_item("rail.smoothing"));
        CHECK_FALSE(shell->has("view.pin.2.0"));
    }
    THEN("a second time they are known") {
        shell->app().place().ask(FileQuestion::Verdicts);
        answer_and_wait(*shell, beside_project(*shell, "verdicts.json"));
        CHECK_THAT(last_message(*shell).text, Contains("entered already"));
    }
    THEN("what is no file of verdicts is refused by a message") {
        const auto file = beside_project(*shell, "other.json");
        write_file(file, "{}");
        shell->app().place().ask(FileQuestion::Verdicts);
        answer_and_wait(*shell, file);
        CHECK(last_message(*shell).kind == MessageKind::Error);
        CHECK_THAT(last_message(*shell).text, Contains("other.json"));
        CHECK(status_of_edit(*shell, 1) == ReviewStatus::Accepted);
    }
}

SCENARIO("Several files of verdicts are imported at once", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    const VerdictFile roth = file_of_roth(*shell);
    VerdictFile weiss = roth;
    weiss.reviewer = "C. Weiss";
    write_file(beside_project(*shell, "a.json"), text_of(roth));
    write_file(beside_project(*shell, "b.json"), std::string("{}"));
    write_file(beside_project(*shell, "c.json"), text_of(weiss));
    REQUIRE(click_in_panel(*shell, "review.import"));
    REQUIRE(shell->settle(60s));
    const auto add = [&](const std::string& file) {
        REQUIRE(shell->has("file.entry." + file));
        const ScreenRect rect = shell->app().ui().items().at("file.entry." + file).rect;
        shell->drag(rect.middle_x(), rect.middle_y(), rect.middle_x(), rect.middle_y(),
                    MouseButton::Left, {.control = true});
    };
    WHEN("they are chosen with Ctrl") {
        for (const char* file : {"a.json", "b.json", "c.json"}) add(file);
        click_and_wait(*shell, "file.accept");
        THEN("each is entered by itself, and what is refused is named") {
            CHECK(feature_of(*shell).review()->files == 2);
            CHECK(feature_of(*shell).review()->edits[0].verdicts.size() == 2);
            std::vector<std::string> said;
            for (const Message& message : shell->app().place().document.messages())
                said.push_back(message.text);
            CHECK_THAT(said.at(said.size() - 3), Contains("a.json: 2 verdicts of B. Roth"));
            CHECK_THAT(said.at(said.size() - 2), Contains("b.json"));
            CHECK_THAT(said.back(), Contains("c.json: 2 verdicts of C. Weiss"));
            CHECK_THAT(shell->app().place().document.failure().value().text, Contains("b.json"));
        }
    }
    WHEN("one is taken back with Ctrl, it is not entered") {
        for (const char* file : {"a.json", "c.json", "a.json"}) add(file);
        click_and_wait(*shell, "file.accept");
        CHECK(feature_of(*shell).review()->files == 1);
        CHECK_THAT(last_message(*shell).text, Contains("C. Weiss"));
    }
    WHEN("another one is clicked without Ctrl, it alone is entered") {
        add("a.json");
        REQUIRE(shell->click_item("file.entry.c.json"));
        click_and_wait(*shell, "file.accept");
        CHECK(feature_of(*shell).review()->files == 1);
    }
}

SCENARIO("The review page is written from the review step", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    REQUIRE(click_in_panel(*shell, "review.page"));
    CHECK(shell->app().place().question() == FileQuestion::ReviewPage);
    const auto file = beside_project(*shell, "page.html");
    answer_and_wait(*shell, file);
    if (review_page_bytes().size() < 1000) {  // built without the page
        CHECK(last_message(*shell).kind == MessageKind::Error);
    } else {
        CHECK(last_message(*shell).kind == MessageKind::Success);
        CHECK(std::filesystem::file_size(file) > review_page_bytes().size());
    }
}

SCENARIO("What reviewers wrote is shown in one short line", "[window][review]") {
    const GivenPin pin{.reviewer = "A. Kern", .pin = {.text = std::string(5000, 'x')}};
    CHECK(pin_words(pin).size() < 150);
    CHECK(pin_words({.reviewer = "A. Kern", .pin = {}, .outdated = true}) ==
          "A. Kern: pin (outdated)");
    CHECK(distance_words({.reviewer = "A. Kern",
                          .distance = {.to = Vec3(3, 4, 0), .length = 99, .text = "the neck"}}) ==
          "A. Kern: 5.00 mm, the neck");
    CHECK(verdict_words({.reviewer = "A. Kern\x1b", .time = "soon", .verdict = Verdict::Unsure}) ==
          "A. Kern\\x1b: unsure, soon");
    CHECK(remark_of(ReviewedEdit{}).empty());
}

SCENARIO("A rejected edit is known in every step, until it is changed", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    import_roth(*shell);
    REQUIRE(shell->click_item("rail.smoothing"));
    REQUIRE(shell->settle(60s));
    const ReviewFeature& feature = feature_of(*shell);
    CHECK_FALSE(feature.is_shown());
    REQUIRE(feature.rejected({2, 1}) != nullptr);
    CHECK(remark_of(*feature.rejected({2, 1})) == "B. Roth: too smooth");
    CHECK(feature.rejected({1, 1}) == nullptr);
    Document& document = shell->app().place().document;
    WHEN("it is changed there") {
        document.change(2, {{"iterations", Value(std::int64_t{3})}});
        REQUIRE(wait_until_idle(*shell));
        REQUIRE(shell->settle(60s));
        CHECK(feature.rejected({2, 2}) == nullptr);
    }
    WHEN("the case is closed") {
        shell->app().place().close();
        REQUIRE(shell->settle(60s));
        CHECK(feature.rejected({2, 1}) == nullptr);
    }
}
