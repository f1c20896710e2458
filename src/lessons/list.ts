/** The lessons in their order: what the contents, the links to the next and the last one, and the zip are made from. */

export interface LessonEntry {
  /** File under `lessons/`, without its ending. */
  name: string;
  title: string;
  /** One sentence. */
  about: string;
  /** What it teaches. */
  paper: string;
  /** Folders of the code, from the top of the project. */
  code: readonly string[];
}

export const LESSONS: readonly LessonEntry[] = [
  {
    name: "footsteps-for-a-task",
    title: "Footsteps for a task",
    about: "How recorded footsteps are chosen for a task, and bent until they fit.",
    paper: "Agrawal and van de Panne, Task-based Locomotion, 2016",
    code: ["src/core/templates", "src/core/optimize", "src/core/tasks"],
  },
  {
    name: "stepping-by-triangles",
    title: "Stepping by triangles",
    about: "How two dozen recorded clips become a step that lands anywhere between them.",
    paper:
      "Beacco, Pelechano, Kapadia and Badler, Footstep Parameterized Motion Blending using Barycentric Coordinates, 2015",
    code: ["src/core/blending"],
  },
  {
    name: "when-a-foot-is-down",
    title: "When a foot is down",
    about: "Why thresholds fail to find footplants, and how labelled neighbours vote instead.",
    paper: "Ikemoto, Arikan and Forsyth, Knowing When to Put Your Foot Down, 2006",
    code: ["src/core/contacts", "src/core/cleanup"],
  },
  {
    name: "loops-and-blends",
    title: "Loops and blends",
    about: "How one recorded walk becomes an endless one, and one style turns into another.",
    paper: "Kim and Neff, Automating Expressive Locomotion Generation, 2012",
    code: ["src/core/styles"],
  },
  {
    name: "the-pendulum-and-its-search",
    title: "The pendulum and its search",
    about: "How a walker in a crowd decides where its next feet go.",
    paper:
      "Singh, Kapadia, Reinman and Faloutsos, Evaluating the Costs and Constraints Used to Make Footstep Decisions, 2010",
    code: ["src/core/crowd"],
  },
  {
    name: "one-walk",
    title: "One walk, five ideas",
    about: "From a drag of the mouse to a body that moves: where each of the five papers does its part.",
    paper: "All five",
    code: ["src/core/motion", "src/core/ik", "src/core/quality"],
  },
];
