"""Solving from Python: the tool's bits; statuses; what callbacks and signals raise stops the solve and
comes out of it; solvers of several threads work at the same time; how a solver ends."""

import gc
import os
import signal
import threading
import time
import unittest
import weakref

import support

import hrad


def cornell(**parameters):
    solver = hrad.Solver()
    solver.make_scene("cornell")
    for name, value in dict(parameters, accuracy=0.2).items():
        solver[name] = value
    return solver


def long_solve():
    """One that would take far too long for a test."""
    solver = hrad.Solver()
    solver.make_scene("classroom")
    solver["accuracy"] = 0.0005
    return solver


class Solving(support.Case):
    def test_bits_are_those_of_the_tool(self):
        told = support.hrad_json("solve", "cornell", "--accuracy", "0.2")
        with cornell() as solver:
            self.assert_fails(hrad.ERROR_STATE, "solve", solver.state_hash)
            self.assertEqual(solver.get_stats().iterations, 0)
            self.assertEqual(solver.solve(), hrad.OK)
            self.assertEqual("%016x" % solver.state_hash(), told["state_hash"])
            stats = solver.get_stats()
            for name in ("iterations", "patches", "elements", "leaves", "links", "rays",
                         "error_estimate"):
                self.assertEqual(getattr(stats, name), told[name], name)
            self.assertEqual(stats.converged, 1)
            self.assertEqual(stats.messages.tolist(), [0, 0, 0])

    def test_statuses_that_are_no_errors(self):
        with cornell(max_iterations=1) as solver:
            self.assertEqual(solver.solve(), hrad.NOT_CONVERGED)
            self.assertEqual(solver.get_stats().converged, 0)

    def test_an_error_is_an_exception(self):
        self.assert_fails(hrad.ERROR_SCENE, "patches", self.solver.solve)
        self.assert_fails(hrad.ERROR_SCENE, "patches", self.solver.partition)

    def test_partition(self):
        with cornell() as solver:
            self.assert_fails(hrad.ERROR_STATE, "", solver.patch_owner, 0)
            owner, loads = solver.plan_partition("cost", 3)
            self.assertEqual((owner.shape, loads.shape), ((36,), (3,)))
            self.assertEqual(loads.dtype.names, ("patches", "work", "lower", "upper", "remote"))
            self.assertEqual(sorted(set(owner.tolist())), [0, 1, 2])
            self.assertEqual(loads["patches"].tolist(), [sum(owner == rank) for rank in range(3)])
            self.assertTrue((loads["upper"] > loads["lower"]).any(axis=1).all())
            self.assertEqual(solver.patch_owner(35), 0)
            for ranks in (0, hrad.MOST_RANKS + 1, 2**32 + 1):
                self.assert_misfit("ranks", solver.plan_partition, "cost", ranks)
            self.assert_misfit("method", solver.plan_partition, "luck", 2)
            self.assert_misfit("vtu", solver.export_partition, "grid", 2, "plan.txt")
        self.assertIn("threads: ", self.solver.describe_machine())

    def test_the_end_of_a_solver(self):
        with cornell() as solver:
            pass
        self.assert_misfit("NULL", solver.solve)
        solver.request_stop()
        solver.destroy()
        # One that calls back into itself is freed too.
        solver = cornell()
        solver.set_progress(lambda progress, own=solver: own.request_stop())
        dropped = weakref.ref(solver)
        del solver
        gc.collect()
        self.assertIsNone(dropped())


class Callbacks(support.Case):
    def test_progress(self):
        seen = []
        with cornell() as solver:
            solver.set_progress(seen.append)
            self.assertEqual(solver.solve(), hrad.OK)
        self.assertIn("linking", [progress.stage for progress in seen])
        fractions = [progress.fraction for progress in seen]
        self.assertEqual(fractions, sorted(fractions))

    def test_progress_stops_and_goes_on(self):
        with cornell() as solver:
            solver.solve()
            undisturbed = solver.state_hash()
        with cornell() as solver:
            solver.set_progress(lambda progress: True)
            self.assertEqual(solver.solve(), hrad.STOPPED)
            solver.set_progress(lambda progress: solver.request_stop())
            self.assertEqual(solver.solve(), hrad.STOPPED)
            solver.set_progress(None)
            self.assertEqual(solver.solve(), hrad.OK)
            self.assertEqual(solver.state_hash(), undisturbed)

    def test_an_exception_stops_the_solve_and_comes_out(self):
        calls = []

        def fail(progress):
            calls.append(progress)
            raise LookupError("of mine")
        with long_solve() as solver:
            solver.set_progress(fail)
            for _ in range(2):
                with self.assertRaisesRegex(LookupError, "of mine"):
                    solver.solve()
            self.assertEqual(len(calls), 2)
            # It is raised once.
            self.assertEqual(solver.get_stats().links, 0)

    def test_the_solver_is_closed_to_its_callbacks(self):
        caught = []

        def disturb(progress):
            for method in (solver.solve, solver.get_stats, solver.destroy):
                try:
                    method()
                except hrad.Error as error:
                    caught.append(error.status)
            return True
        with cornell() as solver:
            solver.set_progress(disturb)
            self.assertEqual(solver.solve(), hrad.STOPPED)
            self.assertEqual(caught, [hrad.ERROR_STATE] * 3)

    def test_the_callbacks_live_as_long_as_the_solver(self):
        count = [0]

        def make():
            def add(progress):
                count[0] += 1
            return add
        with cornell() as solver:
            solver.set_progress(make())
            gc.collect()
            solver.solve()
        self.assertGreater(count[0], 0)

    def interrupts(self, solver):
        """Sends SIGINT once the solve is at work: nothing else here takes processor time."""
        begun = time.process_time()

        def interrupt():
            while time.process_time() - begun < 0.3:
                time.sleep(0.01)
            os.kill(os.getpid(), signal.SIGINT)
        thread = threading.Thread(target=interrupt)
        thread.start()
        self.addCleanup(thread.join)
        with self.assertRaises(KeyboardInterrupt):
            solver.solve()

    def test_control_c_without_a_progress_function(self):
        with long_solve() as solver:
            self.interrupts(solver)
            self.assertEqual(solver.get_stats().links, 0)

    def test_control_c_with_one(self):
        with long_solve() as solver:
            solver.set_progress(lambda progress: None)
            self.interrupts(solver)

    def test_stop_from_another_thread(self):
        with long_solve() as solver:
            at_work = threading.Event()
            solver.set_progress(lambda progress: at_work.set())
            thread = threading.Thread(target=lambda: (at_work.wait(), solver.request_stop()))
            thread.start()
            self.assertEqual(solver.solve(), hrad.STOPPED)
            thread.join()


class Threads(support.Case):
    def test_two_solvers_work_at_the_same_time(self):
        together = threading.Barrier(2, timeout=120)
        hashes, messages = {}, {}

        def work(name):
            # Each waits in the middle of its solve until the other is in the middle of its own.
            met = []

            def meet(progress):
                if not met:
                    met.append(together.wait())
            with cornell(threads=1) as solver:
                solver.set_progress(meet)
                solver.solve()
                hashes[name] = solver.state_hash()
                # Each thread has its own last message.
                try:
                    solver["parameter_of_" + name] = 1
                except hrad.Error as error:
                    together.wait()
                    messages[name] = error.message == hrad.error_message() and name in error.message
        threads = [threading.Thread(target=work, args=(name,)) for name in ("one", "two")]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(messages, {"one": True, "two": True})
        with cornell() as solver:
            solver.solve()
            self.assertEqual(set(hashes.values()), {solver.state_hash()})

    def test_a_solver_at_work_is_closed_to_other_threads(self):
        found = []

        def look():
            for method in (solver.get_stats, solver.destroy):
                try:
                    method()
                except hrad.Error as error:
                    found.append(error.status)

        with cornell() as solver:
            def ask(progress):
                thread = threading.Thread(target=look)
                thread.start()
                thread.join()
                raise LookupError("for the thread that solves")
            solver.set_progress(ask)
            self.assertRaises(LookupError, solver.solve)
        self.assertEqual(found, [hrad.ERROR_STATE] * 2)


if __name__ == "__main__":
    unittest.main()
