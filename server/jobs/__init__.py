"""Jobs: work that outlives its request. No web framework in here.

A *job* is one client's handle on *work*, which is addressed by its content and shared by all jobs that ask for it.

- ``service.JobService`` accepts, lists and dismisses jobs.
- ``kinds`` holds one object per kind of job: how its requests are read, computed, stored and answered.
- ``scheduler.Scheduler`` hands tasks of ``work.Work`` to executor slots: ``worker.Worker`` processes, or a
  ``cluster.DaskCluster``.
- ``recorder.JobRecorder`` writes what happens to work into the jobs, and publishes it in ``events.EventLog``.
- ``storage.Storage`` keeps jobs, points of sweeps and whole results in one folder, within the limits of ``retention``.
"""
