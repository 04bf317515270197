// What is computed of a field, as words: read, written and read again.
#include "coupling/scene/field_recipe.h"

#include <gtest/gtest.h>

#include <utility>

namespace interstice::scene {
namespace {

TEST(FieldRecipe, WordsReadBackAsTheSameRecipe) {
  for (const char* method : {"exact", "centre", "subsample:4", "divided", "divided:0.1", "kernel:60 um"})
    for (const char* classes : {"none", "material", "layer", "size:20 um,40 um", "size:17.3um"}) {
      FieldRecipe recipe, again;
      QuantityProblem problem;
      ASSERT_TRUE(try_read_method(method, recipe, problem)) << problem.what;
      ASSERT_TRUE(try_read_classes(classes, recipe, problem)) << problem.what;
      for (const char* word : {"stress", "velocity"})
        ASSERT_TRUE(try_read_field_quantity(word, recipe, problem)) << problem.what;
      ASSERT_TRUE(try_read_method(method_text(recipe), again, problem)) << problem.what;
      ASSERT_TRUE(try_read_classes(classes_text(recipe), again, problem)) << problem.what;
      for (const std::string& word : quantity_words(recipe))
        ASSERT_TRUE(try_read_field_quantity(word, again, problem)) << problem.what;
      EXPECT_EQ(recipe, again) << method << " " << classes;
    }
  FieldRecipe recipe;
  QuantityProblem problem;
  ASSERT_TRUE(try_read_classes("size:20um, 40um", recipe, problem));
  EXPECT_EQ(recipe.classes.edges, (std::vector<double>{20e-6, 40e-6}));
  ASSERT_TRUE(try_read_method("kernel:60um", recipe, problem));
  EXPECT_EQ(recipe.kernel_length, 60e-6);
}

TEST(FieldRecipe, WhatIsNoneSaysWhatIsAllowed) {
  FieldRecipe recipe;
  QuantityProblem problem;
  const auto method = [&](const char* text) {
    EXPECT_FALSE(try_read_method(text, recipe, problem)) << text;
    return problem.what + "; " + problem.allowed + "; " + problem.remedy;
  };
  for (const auto& [text, part] : {std::pair{"subsample", "subsample:1 to subsample:64"},
                                   {"subsample:0", "subsample:1"},
                                   {"subsample:65", "out of range"},
                                   {"divided:1", "least void fraction"},
                                   {"divided:", "least void fraction"},
                                   {"kernel", "length is missing"},
                                   {"kernel:60", "kernel"},
                                   {"kernel:-1um", "not positive"},
                                   {"exact:1", "no method"},
                                   {"", "no method"}})
    EXPECT_NE(method(text).find(part), std::string::npos) << text << ": " << problem.what;
  for (const char* text :
       {"size:", "size:1um,1um", "size:2um,1um", "size:0um", "size:5", "size:1um,", "colour", ""})
    EXPECT_FALSE(try_read_classes(text, recipe, problem)) << text;
  for (const char* text : {"", "speed", "Velocity", "velocity "})
    EXPECT_FALSE(try_read_field_quantity(text, recipe, problem)) << text;
  EXPECT_FALSE(try_read_overlap("both", recipe, problem));
  ASSERT_TRUE(try_read_overlap("union", recipe, problem));
  ASSERT_TRUE(try_read_method("centre", recipe, problem));
  EXPECT_FALSE(goes_together(recipe, problem));
  ASSERT_TRUE(try_read_method("exact", recipe, problem));
  EXPECT_TRUE(goes_together(recipe, problem));
}

}  // namespace
}  // namespace interstice::scene
