#include "app/import/organ_look.h"

#include "haptics/files/input_text.h"

#include <algorithm>
#include <array>

namespace palp
{
namespace
{

struct Known
{
  const char* word;
  OrganLook look;
};

// the first that is in a name: a vessel of the liver is no liver
constexpr std::array kKnown{ Known{ "vessel", { "show", "#d8654f", nullptr } },
  Known{ "artery", { "show", "#d8654f", nullptr } },
  Known{ "aorta", { "show", "#d8654f", nullptr } }, Known{ "vein", { "show", "#0097ce", nullptr } },
  Known{ "cava", { "show", "#0097ce", nullptr } }, Known{ "tumor", { "press", "#90ee90", "hcc" } },
  Known{ "lesion", { "press", "#90ee90", "hcc" } },
  Known{ "nodule", { "press", "#90ee90", "hcc" } },
  Known{ "gallbladder", { "press", "#8b9662", nullptr } },
  Known{ "liver", { "press", "#dd8265", "healthy_liver" } },
  Known{ "kidney", { "press", "#b96653", nullptr } },
  Known{ "spleen", { "press", "#9d6ca2", nullptr } },
  Known{ "stomach", { "press", "#d88469", nullptr } },
  Known{ "pancreas", { "press", "#f9b46f", nullptr } },
  Known{ "skin", { "through", "#b17a65", "skin" } },
  Known{ "body", { "through", "#b17a65", "skin" } },
  Known{ "fat", { "through", "#e6dc46", "fat" } }, Known{ "bone", { "show", "#f1d691", nullptr } },
  Known{ "rib", { "show", "#f1d691", nullptr } },
  Known{ "vertebra", { "show", "#f1d691", nullptr } } };

} // namespace

OrganLook lookOf(const std::string& name)
{
  const std::string text = lowered(name);
  const auto found = std::ranges::find_if(
    kKnown, [&](const Known& known) { return text.find(known.word) != text.npos; });
  return found != kKnown.end() ? found->look : OrganLook{ "press", "#c0685a", nullptr };
}

} // namespace palp
