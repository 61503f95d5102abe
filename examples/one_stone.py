"""A 4.2 mm stone in a thin-walled ureter: does it move, and how large could it be?"""

import stonepass as sp


def main() -> None:
    ureter = sp.Ureter(inner_diameter="3.5 mm", outer_diameter="4.54 mm")
    stone = sp.Stone(diameter="4.2 mm", friction=0.5)

    answer = sp.critical_pressure(stone, ureter)
    print(answer.outcome.name, "-", answer.message)
    print(f"critical pressure  {answer.pressure / 1e3:.2f} kPa")
    print(f"contact pressure   {answer.contact.peak_contact_pressure / 1e3:.2f} kPa at most")

    # The paper's limit of 12 kPa comes from a pig study; patients with stones show 2 to 6 kPa.
    for limit in ("6 kPa", "12 kPa"):
        size = sp.critical_size(ureter, limit)
        print(f"critical size at {limit:>6}  {size.diameter * 1e3:.2f} mm")


if __name__ == "__main__":
    main()
