// SIGINT and SIGTERM: the first asks to finish soon, the second ends the program at once.
#pragma once

void watch_for_interrupt();
bool interrupted();
