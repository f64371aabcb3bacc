#include "tests/support/allocation_guard.h"

#include <cstdlib>
#include <new>

namespace
{

thread_local std::size_t allocations = 0;

void* counted(std::size_t size, std::size_t alignment)
{
  ++allocations;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  if (void* memory = std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment))
  {
    return memory;
  }
  throw std::bad_alloc();
}

} // namespace

// the program's own operators, which the standard lets us replace
void* operator new(std::size_t size)
{
  return counted(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

namespace palp::test
{

AllocationGuard::AllocationGuard() noexcept
  : before_(allocations)
{
}

std::size_t AllocationGuard::count() const noexcept
{
  return allocations - before_;
}

} // namespace palp::test
