// From the layers' exceptions to the public one.
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/diagnostics.h"
#include "brume/scene.h"

namespace brume {

// Throws an Error that no file is at fault for.
[[noreturn]] inline void fail(const std::string& message) { throw Error("error: " + message); }

// Calls `body`; what it throws because of its input or for lack of memory goes on as Error.
template <class Body>
auto with_public_errors(Body&& body) {
  try {
    return std::forward<Body>(body)();
  } catch (const InputError& e) {
    throw Error(e.what());
  } catch (const std::bad_alloc&) {
    fail("not enough memory");
  } catch (const std::length_error&) {  // a container that would pass what memory can ever hold
    fail("not enough memory");
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {  // a thread or a library that cannot start
    fail(e.what());
  }
}

}  // namespace brume
