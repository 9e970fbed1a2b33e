"""Lists the robots with joints, reach and source."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Command:
    """Lists the robots with joints, reach and source."""

    json: bool = False
    """One JSON object a robot instead of the table."""

    def run(self) -> int:
        import msgspec

        from app.kinematics import load_robot, makers_tables, robot_names

        rows = []
        for name in robot_names():
            robot = load_robot(name)
            info = robot.description
            rows.append(
                {
                    "name": name,
                    "title": robot.title,
                    "joints": robot.joint_count,
                    "reach_m": round(float(info.get("reach_m", robot.reach)), 3),
                    "payload_kg": info.get("payload_kg"),
                    "masses": robot.has_inertials,
                    "source": info.get("source", ""),
                }
            )
        if self.json:
            for row in rows:
                print(msgspec.json.encode(row).decode())
            return 0
        print(f"{'name':<18}{'joints':>7}{'reach m':>9}{'load kg':>9}  masses  title · source")
        for row in rows:
            load = "-" if row["payload_kg"] is None else f"{row['payload_kg']:g}"
            masses = "yes" if row["masses"] else "no"
            print(
                f"{row['name']:<18}{row['joints']:>7}{row['reach_m']:>9.3f}{load:>9}  {masses:<6}  "
                f"{row['title']} · {row['source']}"
            )
        print(
            f"\n{', '.join(makers_tables())}: by the maker's table of axes alone, without masses and shapes;"
            "\n--calibration FILE gives one arm its own axes"
        )
        return 0
