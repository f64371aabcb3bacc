#include "app/import/organ_look.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace palp
{
namespace
{

struct Known
{
  const char* word;
  OrganLook look;
};

// the first whose word is in a name: a vessel of the liver is no liver
constexpr std::array kKnown{ Known{ "vessel", { "show", "#d8654f", nullptr } },
  Known{ "artery", { "show", "#d8654f", nullptr } },
  Known{ "arteries", { "show", "#d8654f", nullptr } },
  Known{ "aorta", { "show", "#d8654f", nullptr } }, Known{ "vein", { "show", "#0097ce", nullptr } },
  Known{ "cava", { "show", "#0097ce", nullptr } }, Known{ "tumor", { "press", "#90ee90", "hcc" } },
  Known{ "tumour", { "press", "#90ee90", "hcc" } },
  Known{ "lesion", { "press", "#90ee90", "hcc" } },
  Known{ "cyst", { "press", "#90ee90", nullptr } },
  Known{ "nodule", { "press", "#90ee90", "hcc" } },
  Known{ "gallbladder", { "press", "#8b9662", nullptr } },
  Known{ "liver", { "press", "#dd8265", "healthy_liver" } },
  Known{ "kidney", { "press", "#b96653", nullptr } },
  Known{ "spleen", { "press", "#9d6ca2", nullptr } },
  Known{ "stomach", { "press", "#d88469", nullptr } },
  Known{ "pancreas", { "press", "#f9b46f", nullptr } },
  Known{ "skin", { "through", "#b17a65", "skin" } },
  Known{ "fat", { "through", "#e6dc46", "fat" } }, Known{ "bone", { "show", "#f1d691", nullptr } },
  Known{ "rib", { "show", "#f1d691", nullptr } },
  Known{ "vertebra", { "show", "#f1d691", nullptr } },
  Known{ "spine", { "show", "#f1d691", nullptr } },
  Known{ "sacrum", { "show", "#f1d691", nullptr } },
  Known{ "femur", { "show", "#f1d691", nullptr } },
  Known{ "body", { "through", "#b17a65", "skin" } } };

// of names that tell nothing, in turn: muscle, tissue, connective tissue, bone, mass
constexpr std::array kOthers{ "#c06858", "#80ae80", "#6fb8d2", "#f1d691", "#90ee90" };

bool isAny(char letter, int (*kind)(int))
{
  return kind(static_cast<unsigned char>(letter)) != 0;
}

// with a space at each end: "LiverTumor_2" -> " liver tumor "
std::string wordsOf(const std::string& name)
{
  std::string words = " ";
  char last = ' ';
  for (const char letter : name + " ")
  {
    const bool isLetter = isAny(letter, std::isalpha);
    const bool isNew = isAny(letter, std::isupper) && isAny(last, std::islower);
    (isLetter && !isNew) || words.back() == ' ' ? void() : words.push_back(' ');
    isLetter ? words.push_back(static_cast<char>(std::tolower(letter))) : void();
    last = letter;
  }
  return words;
}

// one of them, or its plural: "liver" is not in "delivery"
bool hasWord(const std::string& words, const std::string& word)
{
  return std::ranges::any_of(std::array{ "", "s", "e", "es" },
    [&](const char* ending) { return words.find(" " + word + ending + " ") != words.npos; });
}

} // namespace

OrganLook lookOf(const std::string& name)
{
  const std::string words = wordsOf(name);
  const auto found =
    std::ranges::find_if(kKnown, [&](const Known& known) { return hasWord(words, known.word); });
  return found != kKnown.end() ? found->look : OrganLook{ "press", kOthers.front(), nullptr };
}

std::vector<OrganLook> looksOf(const std::vector<std::string>& names)
{
  constexpr const char* kPressed = "press";
  std::vector<OrganLook> looks(names.size());
  std::ranges::transform(names, looks.begin(), lookOf);
  std::size_t others = 0;
  for (OrganLook& look : looks)
  {
    look.color = look.color == kOthers.front() ? kOthers[others++ % kOthers.size()] : look.color;
  }
  const auto isPressed = [](const OrganLook& look)
  { return std::string_view(look.role) == kPressed; };
  if (!looks.empty() && std::ranges::none_of(looks, isPressed))
  {
    looks.front().role = kPressed;
  }
  return looks;
}

} // namespace palp
